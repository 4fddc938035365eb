// gait plot: figures of what a model holds.
#include <gtest/gtest.h>

#include <filesystem>
#include <stack>

#include "tool_runner.h"
#include "walking_models.h"

namespace gait::testing {
namespace {

// Every tag that opens closes, in order; returns how many there are.
int expect_well_formed(const std::string& svg) {
  std::stack<std::string> open;
  int tags = 0;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) {
      ADD_FAILURE() << "a tag never ends";
      return tags;
    }
    ++tags;
    const bool closes = svg[at + 1] == '/', alone = svg[end - 1] == '/' || svg[end - 1] == '?';
    const std::size_t name = at + (closes ? 2 : 1);
    const std::string tag = svg.substr(name, svg.find_first_of(" \t\n/>", name) - name);
    if (closes) {
      EXPECT_TRUE(!open.empty() && open.top() == tag) << tag;
      if (!open.empty()) open.pop();
    } else if (!alone) {
      open.push(tag);
    }
  }
  EXPECT_TRUE(open.empty());
  return tags;
}

TEST(Plot, every_figure_is_drawn_the_same_each_time) {
  const TestFolder folder;
  for (const std::string what : {"variance", "scores", "cycles", "speed", "frequency"}) {
    const auto drawn = [&](const std::string& name) {
      const ToolRun run = run_tool({"plot", walking_model(), what, "-o", folder / name});
      EXPECT_EQ(run.exit_code, 0) << what << ": " << run.err;
      EXPECT_EQ(run.err, "");
      return bytes_of(folder / name);
    };
    const std::string svg = drawn("once.svg");
    EXPECT_GT(expect_well_formed(svg), 50) << what;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << what;
    EXPECT_EQ(svg, drawn("again.svg")) << what;
    EXPECT_EQ(drawn("once.png").substr(1, 3), "PNG") << what;
  }
}

TEST(Plot, a_model_without_what_is_drawn_says_how_to_train_one) {
  const TestFolder folder;
  const auto error = [&](const std::string& model, const std::string& what) {
    const ToolRun run = run_tool({"plot", model, what, "-o", folder / "x.svg"});
    EXPECT_EQ(run.exit_code, 1) << what;
    EXPECT_EQ(lines_of(run.err), 1) << run.err;
    EXPECT_NE(run.err.find("train"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.svg"));
  };
  for (const std::string what : {"scores", "cycles"}) error(speed_model(), what);
  for (const std::string what : {"speed", "frequency"}) error(styled_model(), what);
}

TEST(Plot, wrong_words_end_with_two_and_an_unknown_subject_is_told_who_there_is) {
  const TestFolder folder;
  EXPECT_EQ(run_tool({"plot", walking_model(), "scores", "-o", folder / "x.pdf"}).exit_code, 2);
  EXPECT_EQ(run_tool({"plot", walking_model(), "dreams", "-o", folder / "x.svg"}).exit_code, 2);
  const ToolRun run =
      run_tool({"plot", walking_model(), "speed", "--subject", "Bob", "-o", folder / "x.svg"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("'Bob'; it has neutral"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace gait::testing
