// Another program that is fed bytes through its standard input, started without a shell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace gait {

class ChildProcess {
 public:
  // `words`: the program, looked for where the system looks for programs, and its arguments, in
  // UTF-8. Returns null when it cannot be started; `failure` says why:
  // std::errc::no_such_file_or_directory when there is no such program.
  static std::unique_ptr<ChildProcess> start(const std::vector<std::string>& words,
                                             std::error_code& failure);
  ~ChildProcess();  // ends the program when finish() was not called
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // False when the program has gone.
  bool feed(std::span<const unsigned char> bytes);
  // Closes its input and waits until it ends. True when it ended well.
  bool finish();
  // The last line that it wrote to its standard error, once it has ended.
  std::string last_words() const;

 private:
  ChildProcess() = default;

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> words_;  // its standard error
  std::intptr_t process_ = -1, input_ = -1;  // the system's handles
};

}  // namespace gait
