#include "tool_runner.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace gait::testing {

namespace {

// The environment, with PATH replaced when asked for.
std::vector<std::string> environment(const std::string& search_path) {
  std::vector<std::string> words;
  for (char** word = environ; *word != nullptr; ++word)
    if (search_path.empty() || std::string(*word).rfind("PATH=", 0) != 0) words.emplace_back(*word);
  if (!search_path.empty()) words.push_back("PATH=" + search_path);
  return words;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::string own_name() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::string(test->test_suite_name()) + "." + test->name();
}

}  // namespace

TestFolder::TestFolder()
    : path_(std::filesystem::temp_directory_path() /
            ("gait-" + std::to_string(getpid()) + "-" + own_name())) {
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ToolRun run_tool(const std::vector<std::string>& arguments, const std::string& search_path) {
  const std::string said =
      (std::filesystem::temp_directory_path() / ("gait-said-" + std::to_string(getpid()))).string();
  const std::string out = said + ".out", err = said + ".err";
  std::vector<std::string> words{GAIT_TOOL};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment(search_path);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = -1;
  const int failure = posix_spawn(&process, GAIT_TOOL, &actions, nullptr, pointers(words).data(),
                                  pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  ToolRun run;
  if (failure != 0) {
    ADD_FAILURE() << "cannot start " << GAIT_TOOL;
    return run;
  }
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_TRUE(WIFEXITED(status)) << "it crashed: signal " << WTERMSIG(status);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.out = bytes_of(out);
  run.err = bytes_of(err);
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return run;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << "cannot read " << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

int lines_of(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

bool ffmpeg_is_there() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/ffmpeg").c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace gait::testing
