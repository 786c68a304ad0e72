// What stands before the numbers of one frame of a binary dump, in all its forms: with names of columns
// (since 2021), with flags of the box (since 2010), and before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/frames/world.hpp"

namespace grainreel {

// Numbers of either byte order, one behind the other.
class BinaryReader {
  public:
    BinaryReader(ByteSource& source, bool swapped) : source_(source), swapped_(swapped) {}

    // Returns false where the content ends before.
    bool read(std::int32_t& to) { return read_bytes(&to, sizeof to); }
    bool read(std::int64_t& to) { return read_bytes(&to, sizeof to); }
    bool read(double& to) { return read_bytes(&to, sizeof to); }
    bool read(char& to) { return read_bytes(&to, sizeof to); }
    bool read_text(std::string& to, std::size_t size);
    // As many numbers as there still are; returns how many.
    std::size_t read(double* to, std::size_t count);
    // Passes over bytes. Returns false where the content ends before.
    bool pass(std::uint64_t bytes);

    std::uint64_t place() const { return place_; }
    void seek(std::uint64_t place);

  private:
    bool read_bytes(void* to, std::size_t size);  // of one number

    ByteSource& source_;
    bool swapped_;
    std::uint64_t place_ = 0;
};

// How a program wrote all frames of a file.
struct BinaryForm {
    enum class Box { flags, bare, bare_tilted };

    bool magic = false;    // since 2021
    bool swapped = false;  // other byte order than this machine's
    bool narrow = false;   // step and number of grains have 32 bits
    Box box = Box::flags;  // of files without magic: with a word and flags before, or without
};

struct BinaryHead {
    std::uint64_t place = 0;
    std::int64_t step = 0, rows = 0;
    std::optional<double> time{};
    std::string units{};
    std::optional<WorldCell> box{};
    std::int32_t columns = 0, chunks = 0;
    std::vector<std::string> names{};  // of the columns, where the file says them
    std::uint64_t data = 0;            // where the first chunk begins
};

enum class BinaryEnd { whole, nothing, cut, damaged };

// `complaint` says what is damaged, and the reader stands behind it.
BinaryEnd read_binary_head(BinaryReader& in, const BinaryForm& form, BinaryHead& head,
                           std::string& complaint);

// The form of a file by its first bytes; none where no form makes sense of them.
std::optional<BinaryForm> binary_form_of(std::string_view bytes);

// Where the frames of a binary dump lie. Heads are read, numbers are passed over.

struct BinaryFrame {
    std::uint64_t place = 0;  // of the head
    std::int64_t step = 0, rows = 0;
    std::optional<double> time{};
};

struct BinaryIndex {
    std::vector<BinaryFrame> frames;
    std::int32_t columns = 0;
    std::vector<std::string> names;  // of the columns, as the file says; none in old files
    std::string units;
    std::uint64_t end = 0;  // behind the last whole frame
    bool cut = false;       // a frame begins there that is not whole
    std::int64_t cut_step = 0, cut_rows = 0;

    // Frames behind those that are known. Throws UserError with the byte where the content is none of a dump.
    void go_on(BinaryReader& in, const BinaryForm& form, const std::filesystem::path& file);
};

}  // namespace grainreel
