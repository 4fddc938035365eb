// [gait.model]: reading, sharing, replacing and refusing models.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gait/model/model_file.h"
#include "patches/patch.h"

namespace gait::testing {
namespace {

const char* const demo_file = GAIT_PD_FOLDER "/gait-demo.gait";

std::size_t lines_with(const std::vector<std::string>& lines, const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      lines, [&](const std::string& line) { return line.find(text) != std::string::npos; }));
}

TEST(ModelObject, reads_a_file_and_answers) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int model = patch.object(std::string("gait.model mine ") + demo_file + " -blocking");
  patch.record(model, 1, "info");
  patch.at_start({"get sizes", "get rate", "get styles", "get engines", "get labels", "get joints",
                  "get parents", "get obs", "get inputs", "get outputs"},
                 model);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const Model demo = read_model(demo_file);
  const auto row = [&](const char* what) {
    const auto rows = run.numbers("info", what);
    return rows.empty() ? std::vector<double>() : rows.front();
  };
  EXPECT_EQ(row("sizes"),
            (std::vector<double>{double(demo.input.values), double(demo.output.values),
                                 3.0 * demo.body->skeleton.size()}));
  EXPECT_EQ(row("rate"), std::vector<double>{demo.frame_rate});
  EXPECT_EQ(row("parents").size(), demo.body->skeleton.joints.size());
  EXPECT_EQ(row("obs").size(), 2u * demo.input.size());
  const auto info = run.recorded("info");
  EXPECT_EQ(lines_with(info, "engines viterbi map synth style speed"), 1u);
  EXPECT_EQ(lines_with(info, "labels right left"), 1u);
  EXPECT_EQ(lines_with(info, "styles " + demo.styles.front()), 1u);
}

TEST(ModelObject, tells_everybody_of_its_name_and_keeps_the_old_one_when_reading_fails) {
  GAIT_NEEDS_PD();
  const std::string broken = ::testing::TempDir() + "broken.gait";
  std::ofstream(broken) << "not a model";
  Patch patch;
  const int owner = patch.object("gait.model mine -blocking"),
            other = patch.object("gait.model mine");
  const int walker = patch.object("gait.pca mine style");
  patch.record(owner, 1, "owner");
  patch.record(other, 1, "other");
  patch.record(walker, 1, "walker");
  patch.record(walker, 0, "pose");
  patch.at_start({"bang", "bang"}, walker);  // too early
  patch.at_start({std::string("read ") + demo_file}, owner);
  patch.at_start({"bang"}, walker);
  patch.at_start({"read " + broken, "read nowhere.gait"}, owner);
  patch.at_start({"bang"}, walker);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors().size(), 2u) << run.log;
  EXPECT_EQ(lines_with(run.recorded("owner"), "ready mine"), 1u);
  EXPECT_EQ(lines_with(run.recorded("other"), "ready mine"), 1u);
  EXPECT_EQ(lines_with(run.recorded("walker"), "ready mine"), 1u);
  EXPECT_EQ(lines_with(run.recorded("owner"), "failed "), 2u);
  EXPECT_NE(run.log.find("broken.gait"), std::string::npos) << run.log;
  EXPECT_NE(run.log.find("no file 'nowhere.gait'"), std::string::npos) << run.log;
  EXPECT_NE(run.log.find("gait.pca: waiting for mine"), std::string::npos) << run.log;
  EXPECT_EQ(run.numbers("pose", "pose").size(), 2u);
}

TEST(ModelObject, writes_what_it_reads) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int model = patch.object("gait.model gait-demo -blocking");
  patch.at_start({"write copy.gait"}, model);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const Model copy = read_model(run.folder + "/copy.gait"), demo = read_model(demo_file);
  EXPECT_EQ(copy.styles, demo.styles);
}

TEST(ModelObject, refuses_what_it_cannot_use) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int model = patch.object("gait.model gait-demo -blocking");
  patch.object("gait.model gait-demo -loud");
  patch.at_start({"get weather", "get", "read 1 2", "write 7", "hello"}, model);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_NE(run.log.find("gait.model: expected -blocking, got '-loud'"), std::string::npos)
      << run.log;
  EXPECT_NE(run.log.find("gait.model: get: expected joints, inputs"), std::string::npos) << run.log;
  EXPECT_NE(run.log.find("gait.model: write: expected a name, got 7"), std::string::npos)
      << run.log;
}

}  // namespace
}  // namespace gait::testing
