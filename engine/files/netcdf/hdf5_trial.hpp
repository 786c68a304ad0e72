// Checks of HDF5 files, the other form of NetCDF, before the library opens them in earnest. The HDF5 library
// follows pointers of a damaged file wherever they lead, so all that is to be read is tried in a child
// process first.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <string_view>

namespace grainreel {

inline constexpr std::string_view kHdf5Signature("\x89HDF\r\n\x1a\n");

// Each caller of the HDF5 library holds this lock, because the library has one state for all files.
std::mutex& hdf5_library();

bool is_hdf5(const std::filesystem::path& file);

// Compares the length of an HDF5 file with its first bytes. Throws UserError where it was cut off, or where
// its version is not known.
void check_hdf5(const std::filesystem::path& file);

// Reads all of an HDF5 file in a child process, where a crash does no harm: `read_all` may use the library as
// it likes, and what it changes is lost. Throws UserError where the child does not survive that, or not in
// time. Nothing is tried where no child can be made.
void try_in_child(const std::filesystem::path& file, const std::function<void()>& read_all);

}  // namespace grainreel
