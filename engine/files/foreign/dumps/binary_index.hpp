// Where the frames of a binary dump lie. Heads are read, numbers are passed over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/dumps/binary_head.hpp"

namespace grainreel {

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
