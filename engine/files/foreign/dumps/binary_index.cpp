#include "engine/files/foreign/dumps/binary_index.hpp"

#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "engine/mesh/file/mesh_bytes.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, std::uint64_t byte, const std::string& what) {
    refuse_byte(file, static_cast<std::size_t>(byte), what);
}

// Over the parts of a frame. Returns false where the content ends before.
bool pass_chunks(BinaryReader& in, const fs::path& file, const BinaryHead& head) {
    std::int64_t rows = 0;
    for (std::int32_t chunk = 0; chunk < head.chunks; ++chunk) {
        std::int32_t count = 0;
        const std::uint64_t place = in.place();
        if (!in.read(count)) return false;
        if (count < 0 || count % head.columns != 0)
            refuse(file, place,
                   fmt::format("a part of {} numbers in a frame of {} columns; the file is damaged", count,
                               head.columns));
        rows += count / head.columns;
        if (rows > head.rows)
            refuse(
                file, place,
                fmt::format(
                    "the frame of step {} has more rows than the {} that its head says; the file is damaged",
                    head.step, head.rows));
        if (!in.pass(static_cast<std::uint64_t>(count) * sizeof(double))) return false;
    }
    if (rows != head.rows)
        refuse(file, in.place(),
               fmt::format(
                   "the frame of step {} ends here after {} rows, and its head says {}; the file is damaged",
                   head.step, rows, head.rows));
    return true;
}

void check(const BinaryIndex& index, const BinaryHead& head, const fs::path& file) {
    if (index.frames.empty()) return;
    if (head.columns != index.columns || head.names != index.names)
        refuse(file, head.place,
               fmt::format(
                   "the columns change in the frame that begins here: {} ({}), and {} ({}) before; make a "
                   "file of each part",
                   head.columns, excerpt(fmt::format("{}", fmt::join(head.names, " "))), index.columns,
                   excerpt(fmt::format("{}", fmt::join(index.names, " ")))));
}

}  // namespace

void BinaryIndex::go_on(BinaryReader& in, const BinaryForm& form, const fs::path& file) {
    cut = false;
    in.seek(end);
    while (true) {
        BinaryHead head;
        std::string complaint;
        const BinaryEnd found = read_binary_head(in, form, head, complaint);
        if (found == BinaryEnd::nothing) return;
        if (found == BinaryEnd::damaged)
            refuse(file, in.place(), complaint + "; the file is damaged, or is no dump");
        cut_step = head.step;
        cut_rows = head.rows;
        if (found == BinaryEnd::whole) check(*this, head, file);
        cut = found == BinaryEnd::cut || !pass_chunks(in, file, head);
        if (cut) return;
        columns = head.columns;
        names = head.names;
        if (units.empty()) units = head.units;
        frames.push_back({head.place, head.step, head.rows, head.time});
        end = in.place();
    }
}

}  // namespace grainreel
