// Reads tables of numbers with a row for each grain, or for each contact: CSV of ParaView, DEM-Engine, Lethe,
// pandas and spreadsheets, and columns between blanks, as YADE and numpy write them. If there is a column of
// time, the rows of one time are a frame.
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "engine/base/counted.hpp"
#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/line_reader.hpp"
#include "engine/files/foreign/names.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/tables/number_words.hpp"
#include "engine/files/foreign/tables/table_layout.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

using Cells = std::vector<CsvCell>;

// A group of rows that follow each other in the file.
struct RowGroup {
    std::uint64_t byte = 0;  // where they begin
    std::int64_t line = 1, rows = 0, last_line = 0;
};

struct FrameRows {
    RawMoment moment;
    std::vector<RowGroup> groups;
    std::string first_id;  // of its first row, as it stands there
};

// The smallest and the largest number of each column of a table with four columns.
struct Ranges {
    double least[4]{INFINITY, INFINITY, INFINITY, INFINITY},
        most[4]{-INFINITY, -INFINITY, -INFINITY, -INFINITY};

    void add(const Cells& cells, bool decimal_comma) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double value = cell_number(cells[i].text, decimal_comma).value_or(NAN);
            least[i] = std::min(least[i], value);
            most[i] = std::max(most[i], value);
        }
    }
    // Whether the fourth column can be the radius of grains at the places in the other three.
    bool are_spheres() const {
        double extent = 0;
        for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, most[i] - least[i]);
        return least[3] > 0 && most[3] < 0.5 * extent;
    }
};

std::optional<TableLayout> layout_at(const FileStart& head) {
    return layout_of(head.bytes, head.bytes.size() < kHeadBytes);
}

class NumberTable : public RawFile {
  public:
    explicit NumberTable(const std::filesystem::path& file);

    RawFrame read(std::size_t index) const override;

  private:
    [[noreturn]] void fault(const std::string& what) const { refuse_line(file_, line_.number, what); }
    void refuse_measures() const;
    void find_clocks();
    void find_partners();
    void find_frames();
    bool take_row();
    FrameRows& frame_at(double clock);
    void drop_last_frame();
    void sort_frames();
    double clock_in_column(std::size_t column) const;
    void add_rows(std::vector<ColumnFiller>& columns, const RowGroup& group) const;
    void add_row(std::vector<ColumnFiller>& columns) const;
    void name_partners_of(RawTable& contacts) const;
    void name_nameless();

    TableLayout layout_;
    std::vector<std::vector<RowGroup>> groups_;    // the rows of each moment
    std::vector<FrameRows> frames_;                // while they are found: in the order in which they begin
    std::map<double, std::size_t> frame_of_;       // for each time or step: its last frame
    std::optional<std::size_t> time_, step_, id_;  // numbers of these columns
    std::optional<Partners> partners_;             // of a table of contacts
    double time_unit_ = 1;                         // s
    double last_ = 0;                              // time or step of the last row
    Ranges ranges_;
    mutable std::mutex reading_;
    mutable LineReader lines_;
    mutable TextLine line_;  // the present line
    mutable Cells cells_;    // cells of the present row
};

NumberTable::NumberTable(const std::filesystem::path& file) : RawFile(file), lines_(file) {
    const std::optional<TableLayout> layout = layout_at(unpacked_head(file));
    if (!layout) throw UserError("{}:1: is no table of numbers", file.string());
    layout_ = *layout;
    refuse_measures();
    facts_.format = "table of numbers";
    facts_.program = layout_.program;
    find_clocks();
    find_partners();
    find_frames();
    name_nameless();
}

// Refuses a measures.csv of a run of grainreel, which has a row for each moment and not for each grain.
void NumberTable::refuse_measures() const {
    const auto has = [&](const char* name) { return contains(layout_.names, name); };
    if (has("step") && has("time_s") && has("cycles") && !has("x") && !has("x_m"))
        throw UserError(
            "{}: is the table of measures of a run of ours, a row a moment, and holds no grains; name "
            "the run's folder, or make its charts by: {} report DIR --charts charts",
            file_.string(), program_call());
}

// Finds the columns of time and step. If two columns fit, the first is taken.
void NumberTable::find_clocks() {
    constexpr std::array<const char*, 5> times{"time", "timevalue", "time value", "simulation time", "zeit"};
    constexpr std::array<const char*, 5> steps{"step", "timestep", "time step", "frame", "iteration"};
    if (!layout_.named) return;
    for (std::size_t i = 0; i < layout_.names.size(); ++i) {
        const std::string& name = layout_.names[i];
        const std::string bare = bare_name(name);
        const bool small_t = bare == "t" && name.starts_with('t');  // T would be a temperature
        if (layout_.is_word[i]) continue;
        if (!time_ && (small_t || contains(times, bare))) {
            time_ = i;
            time_unit_ = unit_size_in(unit_of_name(name), Dimension::time).value_or(1);
        }
        if (!step_ && contains(steps, bare)) step_ = i;
    }
    RawTable named;
    for (const std::string& name : layout_.names) named.columns.push_back({name, {}, {}});
    id_ = column_for("id", named, {}, file_.string());
}

// A table of grains may have columns of contacts too ("contact_number", "force_1"), but it has sizes.
void NumberTable::find_partners() {
    if (!layout_.named) return;
    RawTable named;
    for (const std::string& name : layout_.names) named.columns.push_back({name, {}, {}});
    partners_ = partners_in(named);
    const bool sizes = column_for("radius", named, {}, "") || column_for("diameter", named, {}, "");
    if (sizes || (partners_ && (layout_.is_word[partners_->first] || layout_.is_word[partners_->second])))
        partners_.reset();
    if (partners_) id_.reset();
}

double NumberTable::clock_in_column(std::size_t column) const {
    const std::optional<double> value = cell_number(cells_[column].text, layout_.decimal_comma);
    if (!value || !std::isfinite(*value))
        fault(fmt::format("column {} ({}) has {}, which is no time", column + 1, layout_.names[column],
                          in_quotes(cells_[column].text)));
    return *value;
}

// The frame that the present row belongs to. Rows of one time may be apart in the file. If the first grain of
// the time comes again, a run has gone on from an earlier moment and written this one anew.
FrameRows& NumberTable::frame_at(double clock) {
    const auto known = frame_of_.find(clock);
    if (known != frame_of_.end()) {
        FrameRows& frame = frames_[known->second];
        const bool again =
            frame.groups.back().last_line + 1 < line_.number && id_ && cells_[*id_].text == frame.first_id;
        if (!again) return frame;
    }
    frame_of_[clock] = frames_.size();
    FrameRows& frame = frames_.emplace_back();
    if (id_) frame.first_id = cells_[*id_].text;
    return frame;
}

// Orders the frames by time. If a time comes twice, the order in which they were written tells what a restart
// gave up, and stays.
void NumberTable::sort_frames() {
    if (frames_.size() != frame_of_.size()) return;
    std::vector<FrameRows> sorted;
    for (const auto& [clock, frame] : frame_of_) sorted.push_back(std::move(frames_[frame]));
    frames_ = std::move(sorted);
}

void NumberTable::drop_last_frame() {
    const auto last = frame_of_.find(last_);
    if (last == frame_of_.end()) return;
    const std::size_t gone = last->second;
    frame_of_.erase(last);
    for (auto& [clock, frame] : frame_of_)
        if (frame > gone) --frame;
    frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(gone));
}

// Adds the present row to the frame of its time. Returns false where the file ends within the row.
bool NumberTable::take_row() {
    split_cells(line_.text, layout_.form, cells_);
    const std::optional<std::size_t> clock = time_ ? time_ : step_;
    if (cells_.size() < layout_.names.size() && !line_.ended) {
        if (clock && *clock + 1 < cells_.size()) last_ = clock_in_column(*clock);
        return false;
    }
    if (cells_.size() != layout_.names.size())
        fault(fmt::format("this row has {} in place of {}", counted(cells_.size(), "column"),
                          layout_.names.size()));
    last_ = clock ? clock_in_column(*clock) : 0.0;
    FrameRows& frame = frame_at(last_);
    RawMoment& moment = frame.moment;
    if (moment.grains == 0) {
        if (time_) moment.time = last_ * time_unit_;
        if (step_) {
            const double step = clock_in_column(*step_);
            if (!(std::abs(step) < 9e18))
                fault(fmt::format("column {} ({}) has {}, which is no step of a run", *step_ + 1,
                                  layout_.names[*step_], in_quotes(cells_[*step_].text)));
            moment.step = static_cast<std::int64_t>(std::llround(step));
        }
    }
    ++moment.grains;
    if (frame.groups.empty() || frame.groups.back().last_line + 1 != line_.number)
        frame.groups.push_back({line_.place, line_.number, 0, 0});
    ++frame.groups.back().rows;
    frame.groups.back().last_line = line_.number;
    if (!layout_.named && cells_.size() == 4) ranges_.add(cells_, layout_.decimal_comma);
    return true;
}

void NumberTable::find_frames() {
    while (line_.number < layout_.head_lines && lines_.next(line_)) continue;
    bool whole = true, shut = line_.ended;
    while (whole && lines_.next_with_words(line_)) {
        shut = line_.ended || (layout_.form.closed && trimmed(line_.text).ends_with(layout_.form.separator));
        if (is_remark(line_.text)) continue;
        whole = take_row();
    }
    const std::string name = file_.string();
    const bool many = frames_.size() > 1;
    if (!whole && !many)
        throw UserError("{}:{}: the file ends within a row; was it copied or written to the end?", name,
                        line_.number);
    if (many && (!whole || !shut)) {
        news_.push_back(
            fmt::format("{}: its last frame is cut off in line {} and is left out", name, line_.number));
        drop_last_frame();
    } else if (!shut) {
        news_.push_back(fmt::format("{}: its last line has no end; its last number may be cut", name));
    }
    if (lines_.cut_off()) news_.push_back(fmt::format("{}: its packed bytes end too early", name));
    if (frames_.empty()) frames_.emplace_back();
    sort_frames();
    for (FrameRows& frame : frames_) {
        if (partners_) {
            frame.moment.has_contacts = frame.moment.grains > 0;
            frame.moment.grains = 0;
        }
        moments_.push_back(frame.moment);
        groups_.push_back(std::move(frame.groups));
    }
    frames_.clear();
    frame_of_.clear();
    moments_.back().open = true;  // no table says how many rows a moment has
}

void NumberTable::name_nameless() {
    if (layout_.named) return;
    const std::string name = file_.string();
    if (layout_.names.size() == 4 && ranges_.are_spheres()) {
        layout_.names = {"x", "y", "z", "radius"};
        facts_.format = "table of numbers without names";
        news_.push_back(name + ": its columns have no names; the four are taken as x, y, z, radius");
        return;
    }
    news_.push_back(
        fmt::format("{}: its columns have no names; they are called c1 to c{}, and --columns "
                    "\"x=c1,y=c2,z=c3\" says what they are",
                    name, layout_.names.size()));
}

bool is_place(const std::string& name) {
    const std::string bare = bare_name(name);
    return bare == "x" || bare == "y" || bare == "z" || bare == "p_x" || bare == "p_y" || bare == "p_z";
}

void NumberTable::add_row(std::vector<ColumnFiller>& columns) const {
    split_cells(line_.text, layout_.form, cells_);
    if (cells_.size() != columns.size()) fault("the file has changed while it was read");
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].kind() == CellKind::word) {
            columns[i].add(cells_[i].text);
            continue;
        }
        const std::optional<double> value = cell_number(cells_[i].text, layout_.decimal_comma);
        if (!value)
            fault(fmt::format("column {} ({}) has {}, which is no number", i + 1, columns[i].name(),
                              in_quotes(cells_[i].text)));
        if (!std::isfinite(*value) && !partners_ && is_place(columns[i].name()))
            fault(fmt::format("the grain has no place: its {} is {}", columns[i].name(),
                              in_quotes(cells_[i].text)));
        columns[i].add_number(*value);
    }
}

void NumberTable::add_rows(std::vector<ColumnFiller>& columns, const RowGroup& group) const {
    lines_.seek(group.byte, group.line);
    for (std::int64_t row = 0; row < group.rows; ++row) {
        if (!lines_.next(line_)) fault("the file has become shorter while it was read");
        add_row(columns);
    }
}

// Gives the partners names that are known. DEM-Engine has the number of a wall or mesh in the second column,
// if its contact_type says so; in all formats wall k is the partner -1 - k.
void NumberTable::name_partners_of(RawTable& contacts) const {
    RawColumn& second = contacts.columns[partners_->second];
    if (const RawColumn* const kind = contacts.find("contact_type"); kind && !kind->words.empty())
        for (std::size_t row = 0; row < contacts.rows; ++row) {
            const std::string& word = kind->words[static_cast<std::size_t>(kind->values[row])];
            if (word == "SA" || word == "SM") second.values[row] = -1 - second.values[row];
        }
    if (column_for("id1", contacts, {}, "") && column_for("id2", contacts, {}, "")) return;
    const std::vector<double> one = contacts.columns[partners_->first].values, other = second.values;
    contacts.columns.push_back({"id1", one, {}});
    contacts.columns.push_back({"id2", other, {}});
}

RawFrame NumberTable::read(std::size_t index) const {
    const std::lock_guard lock(reading_);
    std::vector<ColumnFiller> columns;
    for (std::size_t i = 0; i < layout_.names.size(); ++i)
        columns.emplace_back(layout_.names[i], layout_.is_word[i] ? CellKind::word : CellKind::number);
    for (const RowGroup& group : groups_.at(index)) add_rows(columns, group);
    RawFrame frame;
    frame.time = moments_[index].time;
    frame.step = moments_[index].step;
    RawTable& table = partners_ ? frame.contacts : frame.grains;
    for (const RowGroup& group : groups_[index]) table.rows += static_cast<std::size_t>(group.rows);
    for (ColumnFiller& column : columns) table.columns.push_back(column.finish());
    if (partners_) name_partners_of(table);
    return frame;
}

bool takes_table(const FileStart& head) {
    return !head.folder && layout_at(head).has_value();
}

std::unique_ptr<RawFile> open_table(const std::filesystem::path& file) {
    return std::make_unique<NumberTable>(file);
}

}  // namespace

RawFormat number_table_format() {
    return {"table", "tables of numbers (CSV, tabs, blanks), a row a grain or a contact", takes_table,
            open_table};
}

}  // namespace grainreel
