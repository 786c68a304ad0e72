// Reads the heads of binary dumps, in all forms that LAMMPS has written (with names of columns since 2021,
// with flags of the box since 2010, and older), and finds where the frames of a file lie. The numbers
// themselves are read in lammps_binary.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

// Reads numbers in either byte order, one after the other.
class BinaryReader {
  public:
    BinaryReader(ByteSource& source, bool swapped) : source_(source), swapped_(swapped) {}

    // These functions return false where the content ends before the number does.
    bool read(std::int32_t& to) { return read_bytes(&to, sizeof to); }
    bool read(std::int64_t& to) { return read_bytes(&to, sizeof to); }
    bool read(double& to) { return read_bytes(&to, sizeof to); }
    bool read(char& to) { return read_bytes(&to, sizeof to); }
    bool read_text(std::string& to, std::size_t size);
    // Reads up to `count` numbers; returns how many there were.
    std::size_t read(double* to, std::size_t count);
    // Skips so many bytes. Returns false where the content has fewer.
    bool pass(std::uint64_t bytes);

    std::uint64_t place() const { return place_; }
    void seek(std::uint64_t place);

  private:
    bool read_bytes(void* to, std::size_t size);  // reads one number

    ByteSource& source_;
    bool swapped_;
    std::uint64_t place_ = 0;
};

// The form in which a program wrote all frames of a file.
struct BinaryForm {
    // What stands at the box in a file without magic word. flags: a word for the tilt and six flags of the
    // boundaries, then the bounds; bare: only the bounds; bare_tilted: the bounds and three tilts. Files with
    // magic word have the flags too.
    enum class Box { flags, bare, bare_tilted };

    bool magic = false;    // begins with a magic word, since 2021
    bool swapped = false;  // the byte order is not that of this machine
    bool narrow = false;   // step and number of grains have 32 bits
    Box box = Box::flags;  // what stands at the box
};

// What the head of a frame says.
struct BinaryHead {
    std::uint64_t place = 0;
    std::int64_t step = 0, rows = 0;
    std::optional<double> time{};
    std::string units{};
    std::optional<WorldCell> box{};
    std::int32_t columns = 0, chunks = 0;
    std::vector<std::string> names{};  // names of the columns, where the file has them
    std::uint64_t data = 0;            // place of the first chunk
};

// How far a head could be read. nothing: the content ends before it; cut: the content ends within it.
enum class BinaryEnd { whole, nothing, cut, damaged };

// Reads a head. If it is damaged, `complaint` says what is wrong, and the reader stands behind the damaged
// number.
BinaryEnd read_binary_head(BinaryReader& in, const BinaryForm& form, BinaryHead& head,
                           std::string& complaint);

// The form of a file, by its first bytes; none where they fit no form.
std::optional<BinaryForm> binary_form_of(std::string_view bytes);

struct BinaryFrame {
    std::uint64_t place = 0;  // byte at which its head begins
    std::int64_t step = 0, rows = 0;
    std::optional<double> time{};
};

// The places of the frames in a file. To find them, heads are read and numbers are skipped.
struct BinaryIndex {
    std::vector<BinaryFrame> frames;
    std::int32_t columns = 0;
    std::vector<std::string> names;  // names of the columns as in the file; none in old files
    std::string units;
    std::uint64_t end = 0;  // after the last whole frame
    bool cut = false;       // a frame that is not whole begins at `end`
    std::int64_t cut_step = 0, cut_rows = 0;

    // Finds the frames after those that are known. Throws UserError with the byte where the content is no
    // dump or its columns change.
    void go_on(BinaryReader& in, const BinaryForm& form, const std::filesystem::path& file);
};

}  // namespace grainreel
