#include "gait/platform/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

extern char** environ;

namespace gait {

std::unique_ptr<ChildProcess> ChildProcess::start(const std::vector<std::string>& words,
                                                  std::error_code& failure) {
  failure.clear();
  std::unique_ptr<ChildProcess> child(new ChildProcess);
  child->words_.reset(std::tmpfile());
  std::array<int, 2> ends{};
  if (child->words_ == nullptr || pipe(ends.data()) != 0) {
    failure = {errno, std::generic_category()};
    return nullptr;
  }
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
  // A program that vanishes must be an error, not the end of this one.
  std::signal(SIGPIPE, SIG_IGN);

  std::vector<std::string> copies = words;
  std::vector<char*> argv;
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(child->words_.get()), STDERR_FILENO);
  pid_t process = -1;
  const int refused =
      posix_spawnp(&process, words.front().c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  child->input_ = ends[1];
  if (refused != 0) {
    failure = {refused, std::generic_category()};
    return nullptr;
  }
  child->process_ = process;
  return child;
}

ChildProcess::~ChildProcess() {
  if (input_ >= 0) close(static_cast<int>(input_));
  if (process_ <= 0) return;
  kill(static_cast<pid_t>(process_), SIGTERM);
  waitpid(static_cast<pid_t>(process_), nullptr, 0);
}

bool ChildProcess::feed(std::span<const unsigned char> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(static_cast<int>(input_), bytes.data(), bytes.size());
    if (count > 0)
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      return false;
  }
  return true;
}

bool ChildProcess::finish() {
  if (input_ >= 0) close(static_cast<int>(std::exchange(input_, -1)));
  if (process_ <= 0) return false;
  int status = 0;
  while (waitpid(static_cast<pid_t>(process_), &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string ChildProcess::last_words() const {
  std::rewind(words_.get());
  std::string last, line;
  for (int c = std::fgetc(words_.get());; c = std::fgetc(words_.get())) {
    if (c != EOF && c != '\n' && c != '\r') {
      line += static_cast<char>(c);
      continue;
    }
    if (line.find_first_not_of(" \t") != std::string::npos) last = line;
    line.clear();
    if (c == EOF) return last;
  }
}

}  // namespace gait
