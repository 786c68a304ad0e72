// Reads text dumps of LAMMPS and LIGGGHTS: dump atom, dump custom, dump local. Frames are found by
// text_index.hpp and rows are read by text_rows.hpp.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <memory>
#include <mutex>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/dumps/dump_parts.hpp"
#include "engine/files/foreign/dumps/index_file.hpp"
#include "engine/files/foreign/dumps/text_index.hpp"
#include "engine/files/foreign/dumps/text_rows.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// The columns of a dump that does not name them, as LAMMPS wrote until 2010: "ITEM: ATOMS" and rows of
// id type xs ys zs [ix iy iz].
struct OldColumns {
    std::vector<std::string> names{};
    std::string words{};  // a text for the user that says how they were found
};

std::size_t words_in(std::string_view text) {
    WordReader words(text);
    std::size_t count = 0;
    while (!words.next_in_line().empty()) ++count;
    return count;
}

// A grain may be outside a periodic box by this share of its size, because LAMMPS moves grains back into the
// box only when it makes its neighbour lists.
constexpr double outside = 0.02;

// Whether the places (the third to the fifth column) are fractions of the box and not lengths.
bool scaled(const RawTable& table, const std::optional<WorldCell>& box) {
    bool in_box = true, wide = false;
    double room = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<double>& values = table.columns[2 + k].values;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        if (*least < -outside || *most > 1 + outside) return false;
        if (*most - *least > 0.5) wide = true;
        const auto axis = static_cast<Eigen::Index>(k);
        const double low = box ? box->origin[axis] : 0, size = box ? box->edges[k][axis] : 0;
        room *= size;
        if (*least < low - outside * size || *most > low + (1 + outside) * size) in_box = false;
    }
    // All places are between 0 and 1, which lengths can be too: a bed of millimetres in a box of centimetres.
    // They are lengths only if they lie in the box, span at most half of 0 to 1 along each axis, and fill
    // more of the box as lengths than as fractions.
    return wide || !in_box || room > 1;
}

// Finds the columns by `frame`, the first frame that has rows. Rows with five or eight words have the columns
// above; scaled() tells whether their places are "x" or "xs". Other rows get columns "c1", "c2", ...
OldColumns old_columns(LineReader& lines, const std::filesystem::path& file, const DumpFrame& frame) {
    OldColumns columns;
    lines.seek(frame.place, frame.line);
    DumpHead head;
    TextLine line;
    if (read_head(lines, file, head) != HeadEnd::whole || !lines.next_with_words(line)) return columns;
    const std::size_t width = words_in(line.text);
    for (std::size_t k = 0; k < width; ++k) columns.names.push_back(fmt::format("c{}", k + 1));
    columns.words = fmt::format("does not name its {} columns; they are called c1 to c{}", width, width);
    if (width != 5 && width != 8) return columns;

    lines.seek(head.rows_place, head.rows_line);
    const RawTable table =
        read_rows(lines, file, {columns.names, frame.rows, frame.end - head.rows_place, false});
    columns.names = {"id", "type", "x", "y", "z"};
    if (scaled(table, head.box))
        for (std::size_t k = 2; k < 5; ++k) columns.names[k] += 's';
    if (width == 8) columns.names.insert(columns.names.end(), {"ix", "iy", "iz"});
    columns.words = fmt::format("does not name its columns; taken as {}, as old dumps have them",
                                fmt::join(columns.names, " "));
    return columns;
}

class LammpsText : public RawFile {
  public:
    explicit LammpsText(const fs::path& file) : RawFile(file), packing_(packing_of(file)), growth_(file) {
        refuse_yaml();
        find_frames();
        if (index_.frames.empty()) refuse_without_frame();
        if (index_.names.empty()) name_columns();
        update();
    }

    RawFrame read(std::size_t index) const override {
        const DumpFrame& frame = index_.frames.at(index);
        // The reader stays for the next frame, because it has mostly read some of it already, and because a
        // place in a packed file can only be reached through all bytes before it. It is closed after the last
        // frame, so that a series of many files does not keep all of them open.
        const std::lock_guard lock(reading_);
        std::unique_ptr<LineReader> lines = std::move(kept_);
        if (!lines) lines = std::make_unique<LineReader>(file_);
        RawFrame read = read_frame(*lines, frame);
        if (index + 1 < index_.frames.size()) kept_ = std::move(lines);
        return read;
    }

    std::vector<std::string> news() const override;
    bool grow() override;
    bool grows() const override { return true; }

  private:
    void refuse_yaml() const;
    [[noreturn]] void refuse_without_frame() const;
    void find_frames();
    void name_columns();
    void update();
    RawFrame read_frame(LineReader& lines, const DumpFrame& frame) const;
    std::string cut_words() const;

    Packing packing_;
    Growth growth_;
    TextIndex index_;
    OldColumns old_;  // only for files without names
    mutable std::mutex reading_;
    mutable std::unique_ptr<LineReader> kept_;
};

void LammpsText::refuse_yaml() const {
    const FileStart head = unpacked_head(file_);
    if (head.bytes.starts_with("---"))
        throw UserError(
            "{}: a dump in YAML (dump yaml), which is not read; let LAMMPS write dump custom, or "
            "write it anew by rerun",
            shown(file_));
}

void LammpsText::find_frames() {
    // For a packed file below this size no kept index is looked for.
    constexpr std::uint64_t packed_long_pass = std::uint64_t{1} << 20;  // bytes
    const bool large = growth_.state().size >= (packing_ == Packing::none ? long_pass : packed_long_pass);
    if (std::optional<KeptIndex> kept; large && (kept = kept_index(file_, growth_.state()))) {
        index_ = std::move(kept->index);
        if (kept->of_now) return;
    }
    const std::uint64_t known = index_.end;
    LineReader lines(file_);
    index_.go_on(lines, file_);
    if (index_.end - known >= long_pass) keep_index(file_, growth_.state(), index_);
}

void LammpsText::refuse_without_frame() const {
    if (!index_.cut) throw NotYetWhole("{}: holds no frame", shown(file_));
    throw NotYetWhole("{}:{}: no frame of this file is whole, neither is the one that begins here: {}",
                      shown(file_), index_.cut->line, cut_words());
}

// Says why the frame at the end is not whole.
std::string LammpsText::cut_words() const {
    const CutFrame& cut = *index_.cut;
    if (cut.in_head) return "it is cut within its head";
    if (cut.in_number) return "its last row is cut or still being written, for no line ends behind it";
    if (cut.in_row) return fmt::format("it is cut within the row {} of its {}", cut.rows, cut.of);
    return fmt::format("it is cut after {} of its {} rows", cut.rows, cut.of);
}

void LammpsText::name_columns() {
    const auto first = std::find_if(index_.frames.begin(), index_.frames.end(),
                                    [](const DumpFrame& f) { return f.rows > 0; });
    if (first == index_.frames.end()) return;
    LineReader lines(file_);
    old_ = old_columns(lines, file_, *first);
}

void LammpsText::update() {
    facts_.format = index_.pairs ? "LAMMPS text dump of pairs" : "LAMMPS text dump";
    facts_.units = index_.units;
    moments_.clear();
    for (const DumpFrame& frame : index_.frames) {
        RawMoment moment;
        moment.step = frame.step;
        moment.time = frame.time;
        moment.grains = index_.pairs ? 0 : frame.rows;
        moment.has_contacts = index_.pairs;
        moments_.push_back(moment);
    }
    if (!moments_.empty()) moments_.back().open = index_.unended;
}

RawFrame LammpsText::read_frame(LineReader& lines, const DumpFrame& frame) const {
    lines.seek(frame.place, frame.line);
    DumpHead head;
    if (read_head(lines, file_, head) != HeadEnd::whole || head.step != frame.step || head.rows != frame.rows)
        refuse_line(
            file_, frame.line,
            fmt::format("the frame of step {} is no longer here; did another program change the file?",
                        frame.step));
    RowsToRead wanted;
    wanted.names = index_.names.empty() ? old_.names : index_.names;
    wanted.rows = frame.rows;
    wanted.bytes = frame.end - head.rows_place;
    wanted.pairs = index_.pairs;
    RawFrame read;
    read.step = frame.step;
    read.time = frame.time;
    read.box = head.box;
    (index_.pairs ? read.contacts : read.grains) = read_rows(lines, file_, wanted);
    if (const std::optional<BadId> bad = bad_id(read.grains))
        refuse_line(file_, head.rows_line + static_cast<std::int64_t>(bad->row), bad->words());
    return read;
}

std::vector<std::string> LammpsText::news() const {
    std::vector<std::string> news;
    const std::string name = shown(file_.filename());
    if (index_.stream_cut)
        news.push_back(
            fmt::format("{}: the packed content is cut; what stands before the cut is read", name));
    if (index_.cut) {
        const std::size_t whole = index_.frames.size();
        const std::string which = index_.cut->step ? fmt::format(" (step {})", *index_.cut->step) : "";
        news.push_back(fmt::format("{}: the last frame{} is left out: {}; {} before it {} whole", name, which,
                                   cut_words(), whole, whole == 1 ? "is" : "are"));
    }
    if (index_.unended)
        news.push_back(fmt::format("{}: no line ends behind its last row, which is taken as whole", name));
    if (!old_.words.empty()) news.push_back(fmt::format("{}: {}", name, old_.words));
    return news;
}

bool LammpsText::grow() {
    if (!growth_.look()) return false;
    const std::size_t had = index_.frames.size();
    LineReader lines(file_);
    index_.go_on(lines, file_);
    if (index_.names.empty() && old_.names.empty()) name_columns();
    update();
    kept_.reset();
    return index_.frames.size() > had;
}

// Whether one of the first lines begins with "ITEM: ". A dump in YAML is taken too, and refused with a
// message when it is opened.
bool takes_text_dump(const FileStart& head) {
    std::string_view text = head.bytes;
    drop_byte_order_mark(text);
    constexpr std::size_t first_items = 2000;  // bytes
    if (text.starts_with("---") &&
        text.substr(0, first_items).find("creator: LAMMPS") != std::string_view::npos)
        return true;
    const std::size_t item = text.substr(0, first_items).find("ITEM: ");
    return item != std::string_view::npos && (item == 0 || text[item - 1] == '\n') &&
           text.substr(0, item).find('\0') == std::string_view::npos;
}

std::unique_ptr<RawFile> open_text_dump(const fs::path& file) {
    return std::make_unique<LammpsText>(file);
}

}  // namespace

RawFormat lammps_text_format() {
    return {"lammps-dump", "dumps of LAMMPS and LIGGGHTS (text)", takes_text_dump, open_text_dump};
}

}  // namespace grainreel
