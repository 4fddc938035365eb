// The process that this code runs in: Pd, which loaded it, or the tool.
#pragma once

#include <filesystem>

namespace gait {

// The file of the library or program that has `address` in it, through whatever link it was
// loaded; empty when the system does not know.
std::filesystem::path file_of_code(const void* address);

// A function that the program itself offers; null when there is none of that name.
void* program_function(const char* name);

// The calling thread, and those it makes, give way to all others.
void give_way() noexcept;

// The folder where a program keeps what it must not lose, for this user: $XDG_STATE_HOME, else
// ~/.local/state, else where temporary files go.
std::filesystem::path state_folder();

}  // namespace gait
