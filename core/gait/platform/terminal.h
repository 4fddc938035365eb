// The command line and the terminal that a program was started from.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace gait {

// The arguments after the program's name, in UTF-8.
std::vector<std::string> utf8_arguments(int argc, char** argv);

// Whether a stream goes to a terminal that understands ESC [ K: lines can be written anew.
bool rewrites_lines(std::FILE* stream);

}  // namespace gait
