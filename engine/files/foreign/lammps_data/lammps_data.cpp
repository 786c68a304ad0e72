// Reads data files of LAMMPS and LIGGGHTS (read_data, write_data): the state of spheres at one moment. The
// section "Atoms" says places, types, diameters and densities, "Velocities" how the grains move, and "Atom
// Type Labels" what the types are called. All other sections are passed over.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/line_reader.hpp"
#include "engine/files/foreign/lammps_data/data_columns.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/tables/number_words.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 7> kGrainColumns{"id", "type", "diameter", "density", "x", "y", "z"};
constexpr std::array<const char*, 6> kMotionColumns{"vx", "vy", "vz", "wx", "wy", "wz"};

// A line in two parts, before and after the first "#".
struct Commented {
    std::string_view text, comment;
    explicit Commented(std::string_view line) {
        const std::size_t mark = line.find('#');
        text = trimmed(line.substr(0, mark));
        if (mark != std::string_view::npos) comment = trimmed(line.substr(mark + 1));
    }
};

// The word or number after `key` in the first line, which is a comment: "timestep = 3000, units = si".
std::string_view value_after(std::string_view line, std::string_view key) {
    const std::size_t place = line.find(key);
    if (place == std::string_view::npos) return {};
    std::string_view rest = line.substr(place + key.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(" ="), rest.size()));
    return rest.substr(0, rest.find_first_of(" ,;"));
}

// Whether a line begins a section. Sections begin with a capital letter; the lines of the head and all rows
// begin with a number, except rows with a type label or "xlo".
bool begins_section(std::string_view text) {
    return !text.empty() && text.front() >= 'A' && text.front() <= 'Z';
}

class LammpsDataFile : public RawFile {
  public:
    explicit LammpsDataFile(const fs::path& file);

    RawFrame read(std::size_t) const override { return frame_; }

  private:
    [[noreturn]] void fault(const std::string& what) const { refuse_line(file_, line_.number, what); }
    bool next() { return lines_.next_with_words(line_); }
    void take_first_line(std::string_view line);
    void take_head_line(std::string_view text);
    void take_bounds(const std::vector<std::string_view>& words);
    void take_vector(const std::vector<std::string_view>& words);
    std::int64_t count_in(std::string_view word) const;
    double number_at(const std::vector<std::string_view>& words, std::size_t column, const char* name) const;
    // The rows of a section as words, each with `count` columns at least. Stops at the next section, whose
    // line is in line_ then. Returns whether there is such a line.
    template <typename Take>
    bool rows_of_section(const std::string& section, Take take);
    bool take_atoms(std::string_view style);
    bool take_velocities();
    bool take_labels();
    bool pass_over();
    void choose_columns(const std::string& style, const std::vector<std::string_view>& first);
    void take_atom(const std::vector<std::string_view>& words);
    double type_in(std::string_view word);
    void finish();

    LineReader lines_;
    TextLine line_;  // the present line
    bool last_row_ended_ = true;
    std::int64_t atoms_ = -1;
    std::int64_t types_ = 0;
    WorldCell box_;
    DataColumns columns_;
    std::vector<std::string> labels_;  // of types 1, 2, ...
    std::unordered_map<std::string, double> type_of_label_;
    std::unordered_map<std::int64_t, std::size_t> row_of_id_;
    std::int64_t atoms_line_ = 0;
    RawFrame frame_;
};

LammpsDataFile::LammpsDataFile(const fs::path& file) : RawFile(file), lines_(file) {
    facts_.format = "LAMMPS data file";
    for (std::size_t axis = 0; axis < 3; ++axis) {  // read_data's own box where the file says none
        box_.origin[static_cast<Eigen::Index>(axis)] = -0.5;
        box_.edges[axis] = Vec3::Unit(static_cast<Eigen::Index>(axis));
    }
    if (lines_.next(line_)) take_first_line(line_.text);
    bool more = next();
    for (; more && !begins_section(Commented(line_.text).text); more = next())
        take_head_line(Commented(line_.text).text);
    if (atoms_ < 0) fault("no line says the number of atoms, as in \"100 atoms\"");
    while (more) {
        const std::string line(line_.text);
        const Commented section(line);
        if (section.text == "Atoms")
            more = take_atoms(section.comment);
        else if (section.text == "Velocities")
            more = take_velocities();
        else if (section.text == "Atom Type Labels")
            more = take_labels();
        else
            more = pass_over();
    }
    if (static_cast<std::int64_t>(frame_.grains.rows) != atoms_)
        fault(fmt::format("the file ends after {} of {} atoms; was it copied or written to the end?",
                          frame_.grains.rows, atoms_));
    finish();
}

// write_data says "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 3000, units = si"; our
// own export says "LAMMPS data file by grainreel: bed at 0.3 s; units si, atom_style sphere".
void LammpsDataFile::take_first_line(std::string_view line) {
    const std::string_view version = value_after(line, "version");
    if (!version.empty()) {
        const std::size_t begin = line.find("version") + std::string_view("version").size();
        const std::string_view rest = line.substr(begin, line.find(',', begin) - begin);
        facts_.program = fmt::format("LAMMPS {}", trimmed(rest));
    }
    if (line.find("LIGGGHTS") != std::string_view::npos) facts_.program = "LIGGGHTS";
    frame_.step = whole_in(value_after(line, "timestep"));
    facts_.units = std::string(value_after(line, "units"));
    const std::size_t ours = line.find("by grainreel: "), time = line.rfind(" at ");
    if (ours == std::string_view::npos || time == std::string_view::npos) return;
    facts_.program = "grainreel";
    frame_.time = number_in(value_after(line.substr(time), " at "));
}

std::int64_t LammpsDataFile::count_in(std::string_view word) const {
    const std::optional<std::int64_t> count = whole_in(word);
    if (!count || *count < 0) fault(fmt::format("\"{}\" is no count", excerpt(word)));
    return *count;
}

double LammpsDataFile::number_at(const std::vector<std::string_view>& words, std::size_t column,
                                 const char* name) const {
    const std::optional<double> number = number_in(words[column]);
    if (!number) fault(fmt::format("the {} is {}", name, no_number(words[column])));
    return *number;
}

void LammpsDataFile::take_head_line(std::string_view text) {
    if (text.empty()) return;
    const std::vector<std::string_view> words = words_of(text);
    const std::string_view last = words.back();
    if (words.size() == 2 && last == "atoms") {
        atoms_ = count_in(words[0]);
    } else if (words.size() == 3 && words[1] == "atom" && last == "types") {
        types_ = count_in(words[0]);
    } else if (words.size() == 4 && (last == "xhi" || last == "yhi" || last == "zhi")) {
        take_bounds(words);
    } else if (words.size() == 6 && words[3] == "xy" && words[4] == "xz" && last == "yz") {
        box_.edges[1].x() = number_at(words, 0, "tilt xy");
        box_.edges[2].x() = number_at(words, 1, "tilt xz");
        box_.edges[2].y() = number_at(words, 2, "tilt yz");
    } else if (last == "avec" || last == "bvec" || last == "cvec" || last == "origin") {
        take_vector(words);
    }
}

void LammpsDataFile::take_bounds(const std::vector<std::string_view>& words) {
    const std::size_t axis = static_cast<std::size_t>(words[3].front() - 'x');
    const auto i = static_cast<Eigen::Index>(axis);
    const double low = number_at(words, 0, "low bound"), high = number_at(words, 1, "high bound");
    if (!(high >= low))
        fault(fmt::format("the box ends at {} before it begins at {}", excerpt(words[1]), excerpt(words[0])));
    box_.origin[i] = low;
    box_.edges[axis][i] = high - low;
}

// A box of any three vectors: "1 0 0 avec", "0 1 0 bvec", "0 0 1 cvec", "0 0 0 abc origin".
void LammpsDataFile::take_vector(const std::vector<std::string_view>& words) {
    if (words.size() < 4) fault("three numbers are expected before this word");
    Vec3 vector;
    for (std::size_t k = 0; k < 3; ++k)
        vector[static_cast<Eigen::Index>(k)] = number_at(words, k, "component");
    if (words.back() == "origin")
        box_.origin = vector;
    else
        box_.edges[words.back().front() - 'a'] = vector;
}

template <typename Take>
bool LammpsDataFile::rows_of_section(const std::string& section, Take take) {
    std::vector<std::string_view> words;
    while (next()) {
        const Commented row(line_.text);
        if (row.text.empty()) continue;
        if (begins_section(row.text)) return true;
        split_words(row.text, words);
        take(words);
        last_row_ended_ = line_.ended;
    }
    if (!last_row_ended_)
        news_.push_back(fmt::format("{}: no line ends behind the last row of {}, which is taken as whole",
                                    shown(file_.filename()), section));
    return false;
}

bool LammpsDataFile::pass_over() {
    while (next())
        if (begins_section(Commented(line_.text).text)) return true;
    return false;
}

bool LammpsDataFile::take_labels() {
    return rows_of_section("Atom Type Labels", [&](const std::vector<std::string_view>& words) {
        if (words.size() < 2) fault("a number and a label are expected");
        const std::optional<std::int64_t> type = whole_in(words[0]);
        if (!type || *type != static_cast<std::int64_t>(labels_.size()) + 1)
            fault(fmt::format("{} is not the number of the next type, {}", excerpt(words[0]),
                              labels_.size() + 1));
        labels_.emplace_back(words[1]);
        type_of_label_.emplace(labels_.back(), static_cast<double>(labels_.size()));
    });
}

void LammpsDataFile::choose_columns(const std::string& style, const std::vector<std::string_view>& first) {
    // The first row alone is too little for a guess: a sphere of diameter 1 looks like an atom of type 1. So
    // some rows are read ahead.
    constexpr std::size_t looks = 1000;
    std::vector<std::string> texts;
    const std::uint64_t place = line_.place;
    const std::int64_t number = line_.number;
    std::vector<std::vector<std::string_view>> rows{first};
    if (style.empty()) {
        rows.clear();
        texts.emplace_back(Commented(line_.text).text);
        while (texts.size() < looks && next()) {
            const std::string_view text = Commented(line_.text).text;
            if (begins_section(text)) break;
            if (!text.empty()) texts.emplace_back(text);
        }
        for (const std::string& text : texts) rows.push_back(words_of(text));
        lines_.seek(place, number);
        lines_.next(line_);
    }
    std::string complaint;
    columns_ = data_columns(style, rows, static_cast<std::size_t>(types_), complaint);
    if (!complaint.empty()) refuse_line(file_, style.empty() ? line_.number : atoms_line_, complaint);
    if (columns_.guessed)
        news_.push_back(fmt::format("{}: does not say its atom_style; its {} columns are read as those of {}",
                                    shown(file_.filename()), rows.front().size(), columns_.style));
}

bool LammpsDataFile::take_atoms(std::string_view style) {
    const std::string said(style);
    atoms_line_ = line_.number;
    RawTable& grains = frame_.grains;
    if (!grains.columns.empty()) fault("a second section Atoms");
    for (const char* name : kGrainColumns) grains.columns.push_back({name, {}, {}});
    return rows_of_section("Atoms", [&](const std::vector<std::string_view>& words) {
        if (grains.rows == 0) {
            choose_columns(said, words);
            take_atom(words_of(Commented(line_.text).text));
        } else {
            take_atom(words);
        }
    });
}

void LammpsDataFile::take_atom(const std::vector<std::string_view>& words) {
    RawTable& grains = frame_.grains;
    if (static_cast<std::int64_t>(grains.rows) == atoms_)
        fault(fmt::format("an atom stands behind the {} that the head counts", atoms_));
    if (words.size() < columns_.least)
        fault(fmt::format("this row has {} columns; with atom_style {} a row has {} at least", words.size(),
                          excerpt(columns_.style), columns_.least));
    const std::optional<std::int64_t> id = whole_in(words[columns_.id]);
    if (!id) fault(fmt::format("\"{}\" is no id of an atom", excerpt(words[columns_.id])));
    if (!row_of_id_.emplace(*id, grains.rows).second) fault(fmt::format("atom {} comes twice", *id));
    const std::array<double, 7> values{static_cast<double>(*id),
                                       type_in(words[columns_.type]),
                                       number_at(words, columns_.diameter, "diameter"),
                                       number_at(words, columns_.density, "density"),
                                       number_at(words, columns_.x, "place x"),
                                       number_at(words, columns_.x + 1, "place y"),
                                       number_at(words, columns_.x + 2, "place z")};
    if (!(values[2] > 0))
        fault(fmt::format("atom {} is a point: its diameter is {}; give the spheres a diameter", *id,
                          excerpt(words[columns_.diameter])));
    for (std::size_t k = 0; k < values.size(); ++k) grains.columns[k].values.push_back(values[k]);
    ++grains.rows;
}

// The number of a type, which a file with labels may say by its label.
double LammpsDataFile::type_in(std::string_view word) {
    if (const auto label = type_of_label_.find(std::string(word)); label != type_of_label_.end())
        return label->second;
    const std::optional<std::int64_t> type = whole_in(word);
    if (!type || *type < 1 || (types_ > 0 && *type > types_))
        fault(fmt::format("\"{}\" is no type; the head says {}", excerpt(word),
                          types_ == 1 ? "1 type" : fmt::format("{} types", types_)));
    return static_cast<double>(*type);
}

bool LammpsDataFile::take_velocities() {
    RawTable& grains = frame_.grains;
    if (grains.columns.empty()) fault("the section Velocities stands before the section Atoms");
    if (grains.columns.size() > kGrainColumns.size()) fault("a second section Velocities");
    std::int64_t rows = 0;
    for (const char* name : kMotionColumns)
        grains.columns.push_back({name, std::vector<double>(grains.rows, kUnknown), {}});
    const bool more = rows_of_section("Velocities", [&](const std::vector<std::string_view>& words) {
        if (words.size() < 4) fault("an id and three velocities are expected");
        const std::optional<std::int64_t> id = whole_in(words[0]);
        const auto row = id ? row_of_id_.find(*id) : row_of_id_.end();
        if (row == row_of_id_.end()) fault(fmt::format("there is no atom {}", excerpt(words[0])));
        const std::size_t numbers = words.size() < 7 ? 3 : 6;
        for (std::size_t k = 0; k < numbers; ++k)
            grains.columns[kGrainColumns.size() + k].values[row->second] =
                number_at(words, k + 1, k < 3 ? "velocity" : "spin");
        ++rows;
    });
    if (rows != atoms_)
        fault(fmt::format("the section Velocities has {} rows for {} atoms; was the file written to the end?",
                          rows, atoms_));
    return more;
}

void LammpsDataFile::finish() {
    RawTable& grains = frame_.grains;
    if (!labels_.empty() && !grains.columns.empty()) {
        RawColumn& type = grains.columns[1];
        const bool all = std::all_of(type.values.begin(), type.values.end(), [&](double value) {
            return value <= static_cast<double>(labels_.size());
        });
        if (all) {
            for (double& value : type.values) value -= 1;
            type.words = labels_;
        }
    }
    frame_.box = box_;
    row_of_id_.clear();
    RawMoment moment;
    moment.step = frame_.step;
    moment.time = frame_.time;
    moment.grains = static_cast<std::int64_t>(grains.rows);
    moments_.push_back(moment);
}

// A data file has a first line of any words, and then a head with the number of atoms and of types or the
// box.
bool takes_lammps_data(const FileStart& head) {
    if (head.folder) return false;
    WordReader words(head.bytes);
    words.skip_line();
    bool atoms = false, others = false;
    constexpr int most_lines = 60;
    std::string_view left = words.left();
    for (int k = 0; k < most_lines && !left.empty() && !(atoms && others); ++k) {
        const std::size_t end = left.find('\n');
        const std::vector<std::string_view> line = words_of(Commented(left.substr(0, end)).text);
        left.remove_prefix(end == std::string_view::npos ? left.size() : end + 1);
        if (line.empty()) continue;
        if (line.size() == 2 && line[1] == "atoms" && whole_in(line[0]))
            atoms = true;
        else if (line.back() == "types" || line.back() == "xhi" || line.back() == "avec")
            others = true;
        else if (!number_in(line[0]))
            return false;
    }
    return atoms && others;
}

std::unique_ptr<RawFile> open_lammps_data(const fs::path& file) {
    return std::make_unique<LammpsDataFile>(file);
}

}  // namespace

RawFormat lammps_state_format() {
    return {"lammps-data", "data files of LAMMPS and LIGGGHTS (of spheres)", takes_lammps_data,
            open_lammps_data};
}

}  // namespace grainreel
