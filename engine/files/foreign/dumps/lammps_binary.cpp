// Reads binary dumps of LAMMPS: dump atom and dump custom into a file with the ending .bin.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "engine/base/error.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/dumps/binary_head.hpp"
#include "engine/files/foreign/dumps/dump_parts.hpp"
#include "engine/files/foreign/dumps/index_file.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_numbers = std::size_t{1}
                                      << 15;  // numbers read at once; they fit into a processor's cache

class LammpsBinary : public RawFile {
  public:
    explicit LammpsBinary(const fs::path& file) : RawFile(file), packing_(packing_of(file)), growth_(file) {
        const std::optional<BinaryForm> form = binary_form_of(unpacked_head(file).bytes);
        if (!form) throw UserError("{}: is no binary dump of LAMMPS", shown(file));
        form_ = *form;
        look_for_frames();
        if (index_.frames.empty()) refuse_without_frame();
    }

    RawFrame read(std::size_t index) const override {
        const BinaryFrame& frame = index_.frames.at(index);
        // A packed file stays open, so that the next frame is read without unpacking all bytes before it
        // again. It is closed after its last frame.
        const std::lock_guard lock(reading_);
        std::unique_ptr<ByteSource> source = std::move(kept_);
        if (!source) source = open_bytes(file_);
        RawFrame read = read_frame(*source, frame);
        if (packing_ != Packing::none && index + 1 < index_.frames.size()) kept_ = std::move(source);
        return read;
    }

    std::vector<std::string> news() const override {
        std::vector<std::string> news;
        const std::string name = shown(file_.filename());
        if (stream_cut_)
            news.push_back(
                fmt::format("{}: the packed content is cut; what stands before the cut is read", name));
        if (index_.cut)
            news.push_back(fmt::format(
                "{}: the last frame (step {}) is left out: the file ends within it, or it is cut; "
                "{} before it {} whole",
                name, index_.cut_step, index_.frames.size(), index_.frames.size() == 1 ? "is" : "are"));
        if (index_.names.empty())
            news.push_back(fmt::format(
                "{}: does not name its {} columns, as files of before 2021; they are called c1 to "
                "c{}",
                name, index_.columns, index_.columns));
        return news;
    }

    bool grows() const override { return true; }
    bool grow() override {
        if (!growth_.look()) return false;
        const std::size_t had = index_.frames.size();
        kept_.reset();
        look_for_frames();
        return index_.frames.size() > had;
    }

  private:
    void look_for_frames();
    [[noreturn]] void refuse_without_frame() const;
    RawFrame read_frame(ByteSource& source, const BinaryFrame& frame) const;
    RawTable read_rows(BinaryReader& in, const BinaryHead& head) const;
    void check_numbers(const RawTable& table, const BinaryHead& head) const;
    [[noreturn]] void refuse_changed(std::uint64_t byte) const {
        refuse_byte(file_, static_cast<std::size_t>(byte),
                    "the frame that was here is gone; did another program change the file?");
    }

    Packing packing_;
    Growth growth_;
    BinaryForm form_;
    BinaryIndex index_;
    bool stream_cut_ = false;
    mutable std::mutex reading_;
    mutable std::unique_ptr<ByteSource> kept_;
};

void LammpsBinary::look_for_frames() {
    const std::unique_ptr<ByteSource> source = open_bytes(file_);
    BinaryReader in(*source, form_.swapped);
    index_.go_on(in, form_, file_);
    stream_cut_ = source->cut_off();
    facts_.format =
        index_.names.empty() ? "LAMMPS binary dump without names of columns" : "LAMMPS binary dump";
    facts_.units = index_.units;
    moments_.clear();
    for (const BinaryFrame& frame : index_.frames) {
        RawMoment moment;
        moment.step = frame.step;
        moment.time = frame.time;
        moment.grains = frame.rows;
        moments_.push_back(moment);
    }
}

void LammpsBinary::refuse_without_frame() const {
    throw UserError(
        "{}: no frame of this file is whole: the first one claims {} grains, and the file has {} "
        "bytes; copy it again",
        shown(file_), index_.cut_rows, growth_.state().size);
}

RawFrame LammpsBinary::read_frame(ByteSource& source, const BinaryFrame& frame) const {
    BinaryReader in(source, form_.swapped);
    in.seek(frame.place);
    BinaryHead head;
    std::string complaint;
    if (read_binary_head(in, form_, head, complaint) != BinaryEnd::whole || head.step != frame.step ||
        head.rows != frame.rows || head.columns != index_.columns)
        refuse_changed(frame.place);
    RawFrame read;
    read.step = frame.step;
    read.time = frame.time;
    read.box = head.box;
    read.grains = read_rows(in, head);
    check_numbers(read.grains, head);
    return read;
}

RawTable LammpsBinary::read_rows(BinaryReader& in, const BinaryHead& head) const {
    // head.rows can be trusted: the rows were counted when the frames were looked for.
    RawTable table;
    table.rows = static_cast<std::size_t>(head.rows);
    const auto width = static_cast<std::size_t>(head.columns);
    for (std::size_t c = 0; c < width; ++c)
        table.columns.push_back({head.names.empty() ? fmt::format("c{}", c + 1) : head.names[c],
                                 std::vector<double>(table.rows),
                                 {}});
    const std::size_t block_rows = std::max<std::size_t>(1, block_numbers / width);
    std::vector<double> block(block_rows * width);
    std::size_t row = 0;
    for (std::int32_t chunk = 0; chunk < head.chunks; ++chunk) {
        std::int32_t count = 0;
        if (!in.read(count) || count < 0) refuse_changed(in.place());
        std::size_t left = static_cast<std::size_t>(count) / width;
        if (left > table.rows - row) refuse_changed(in.place());
        while (left > 0) {
            const std::size_t rows = std::min(left, block_rows);
            if (in.read(block.data(), rows * width) < rows * width) refuse_changed(in.place());
            for (std::size_t c = 0; c < width; ++c) {
                double* const to = table.columns[c].values.data() + row;
                for (std::size_t r = 0; r < rows; ++r) to[r] = block[r * width + c];
            }
            row += rows;
            left -= rows;
        }
    }
    if (row < table.rows) refuse_changed(in.place());
    return table;
}

void LammpsBinary::check_numbers(const RawTable& table, const BinaryHead& head) const {
    for (const RawColumn& column : table.columns) {
        if (!must_be_finite(column.name)) continue;
        const auto bad = std::find_if_not(column.values.begin(), column.values.end(),
                                          [](double v) { return std::isfinite(v); });
        if (bad != column.values.end())
            refuse_byte(
                file_, static_cast<std::size_t>(head.place),
                fmt::format(
                    "in the frame of step {} that begins here, {} of the row {} is {}, which is no finite "
                    "number; the run went wrong before it wrote this, use the frames before it",
                    head.step, column.name, bad - column.values.begin() + 1, *bad));
    }
    if (const std::optional<BadId> bad = bad_id(table))
        refuse_byte(file_, static_cast<std::size_t>(head.place),
                    fmt::format("in the frame of step {} that begins here, row {}: {}", head.step,
                                bad->row + 1, bad->words()));
}

bool takes_binary_dump(const FileStart& head) {
    return binary_form_of(head.bytes).has_value();
}

std::unique_ptr<RawFile> open_binary_dump(const fs::path& file) {
    return std::make_unique<LammpsBinary>(file);
}

}  // namespace

RawFormat lammps_binary_format() {
    return {"lammps-binary", "dumps of LAMMPS (binary)", takes_binary_dump, open_binary_dump};
}

}  // namespace grainreel
