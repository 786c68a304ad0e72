// Files in folders that may come from somebody else. Only ordinary files are read: a pipe would be waited for
// without an end, and a device has none. Nothing is written through a link, which may lead to any file.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace grainreel {

// What has that name: "a folder", "a pipe", "a link", ...; empty for an ordinary file, and where nothing has
// it. `behind_links`: what a link leads to counts, not the link.
std::string other_than_file(const std::filesystem::path& path, bool behind_links);

// Whether an ordinary file can be reached by that name.
bool is_plain(const std::filesystem::path& path);

// Reads an ordinary file. The stream has failed from the start where there is none.
std::ifstream read_plain(const std::filesystem::path& path);

// An ordinary file that is there and is no link, for writing. flags: more of open(2). Returns a descriptor,
// or -1 with errno.
int open_plain(const std::filesystem::path& path, int flags = 0);

// A new, empty file in the place of what had the name. Of a link only the link goes. A device (/dev/full)
// stays and is opened. Returns a descriptor, or -1 with errno.
int make_plain(const std::filesystem::path& path);

// For libraries that open a file by its name: removes what has the name, unless it is a folder or a device.
void make_way(const std::filesystem::path& path);

// Makes a folder, or takes the one that is there. A link to a folder is an error.
std::error_code make_plain_folder(const std::filesystem::path& path);

}  // namespace grainreel
