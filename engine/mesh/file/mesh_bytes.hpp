// The bytes of a mesh file, and the complaints about them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace grainreel {

// Indices of vertices and triangles are 32 bits wide.
inline constexpr std::uint64_t largest_mesh_file = (std::uint64_t{1} << 31) - 1;

// All of an ordinary file. Throws UserError where there is none, where it cannot be read, where it is a
// folder, a pipe or a device, where it is empty and where it is larger than 2 GiB.
std::string mesh_bytes(const std::filesystem::path& file);

// Throw UserError: "file: what", "file:line: what", "file: byte 84: what".
[[noreturn]] void refuse_mesh(const std::filesystem::path& file, const std::string& what);
[[noreturn]] void refuse_line(const std::filesystem::path& file, std::int64_t line, const std::string& what);
[[noreturn]] void refuse_byte(const std::filesystem::path& file, std::size_t byte, const std::string& what);

}  // namespace grainreel
