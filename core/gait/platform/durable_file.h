// Files whose content must outlive a crash of the machine.
#pragma once

#include <filesystem>
#include <system_error>

namespace gait {

// Gives the file `from` the name `to`, over a file of that name, which another program may have
// open: it goes on with the old content. What `from` holds is on the disk before `to` names it.
// Returns why it failed; nothing has changed then.
std::error_code replace_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace gait
