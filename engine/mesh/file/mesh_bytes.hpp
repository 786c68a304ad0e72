// The bytes of a mesh file, and error messages about them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace grainreel {

// Largest size of a mesh file, in bytes, because indices of vertices and triangles are 32 bits wide.
inline constexpr std::uint64_t largest_mesh_file = (std::uint64_t{1} << 31) - 1;

// Reads all bytes of an ordinary file. Throws UserError if the file does not exist, cannot be read, is empty
// or larger than 2 GiB, or is a folder, a pipe or a device.
std::string mesh_bytes(const std::filesystem::path& file);

// These throw UserError with the text "file: what", "file:line: what" or "file: byte 84: what".
[[noreturn]] void refuse_mesh(const std::filesystem::path& file, const std::string& what);
[[noreturn]] void refuse_line(const std::filesystem::path& file, std::int64_t line, const std::string& what);
[[noreturn]] void refuse_byte(const std::filesystem::path& file, std::size_t byte, const std::string& what);

}  // namespace grainreel
