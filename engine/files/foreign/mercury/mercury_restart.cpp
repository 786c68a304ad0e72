// Reads MercuryDPM's .restart: the state at one moment, with its walls, as text. In files that begin with
// "MercuryDPM 1.0" or "restart_version 1.0" a grain has keys and values; with restart_version 3 it is a row
// of plain numbers ("TSP BP x y z vx vy vz r angles w 1/m 1/I species"). A grain without the key "position"
// is taken as such a row.
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/base/triangle_mesh.hpp"
#include "engine/base/vector.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/line_reader.hpp"
#include "engine/files/foreign/mercury/plane_in_box.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/tables/number_words.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

namespace {

struct Field {
    const char* key;
    std::vector<const char*> columns;
};
// The keys of a grain, and the columns that they become.
const std::vector<Field>& fields_of_keys() {
    static const std::vector<Field> fields{
        {"id", {"id"}},
        {"indSpecies", {"species"}},
        {"position", {"x", "y", "z"}},
        {"velocity", {"vx", "vy", "vz"}},
        {"angularVelocity", {"wx", "wy", "wz"}},
        {"orientation", {"orientation:0", "orientation:1", "orientation:2", "orientation:3"}},
        {"radius", {"radius"}},
        {"invMass", {"invMass"}},
    };
    return fields;
}
// The columns of a grain without keys, in the order of the row. The empty name skips the inverse moment of
// inertia.
constexpr std::array<const char*, 16> plain_columns{"x",      "y",       "z",    "vx",     "vy", "vz",
                                                    "radius", "alpha",   "beta", "gamma",  "wx", "wy",
                                                    "wz",     "invMass", "",     "species"};

// A line of the file: keys with words after them, "position 0 0 1 radius 0.5".
class RestartLine {
  public:
    explicit RestartLine(std::string_view line) {
        for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
            if (first_word_.empty()) first_word_ = word;
            const std::optional<double> number = number_in(word, Dialect::programs);
            if (!number) {
                entries_.emplace_back(lower_case(word), std::vector<double>());
            } else if (!entries_.empty()) {
                entries_.back().second.push_back(*number);
            }
        }
    }

    // The first word of the line, such as "TSP" or "InfiniteWall".
    const std::string& first_word() const { return first_word_; }
    // The numbers after a key, whose case does not matter; null unless there are exactly `count` of them. If
    // a key comes twice, the last one with so many numbers is taken.
    const std::vector<double>* find(std::string_view key, std::size_t count) const {
        const std::string lower_key = lower_case(key);
        for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)
            if (entry->first == lower_key && entry->second.size() == count) return &entry->second;
        return nullptr;
    }
    std::optional<double> number(std::string_view key) const {
        const std::vector<double>* found = find(key, 1);
        return found ? std::optional(found->front()) : std::nullopt;
    }
    std::optional<Vec3> vector(std::string_view key) const {
        const std::vector<double>* found = find(key, 3);
        if (!found) return std::nullopt;
        return Vec3((*found)[0], (*found)[1], (*found)[2]);
    }
    // The numbers between the first words and the next word.
    const std::vector<double>& first_numbers() const {
        static const std::vector<double> none;
        for (const auto& [key, numbers] : entries_)
            if (!numbers.empty()) return numbers;
        return none;
    }

  private:
    std::string first_word_;
    std::vector<std::pair<std::string, std::vector<double>>> entries_;  // with keys in lower case
};

class MercuryRestart : public RawFile {
  public:
    explicit MercuryRestart(const std::filesystem::path& file);

    RawFrame read(std::size_t) const override { return frame_; }

  private:
    enum class Part { head, species, walls, boundaries, grains, rest };

    [[noreturn]] void fault(const std::string& what) const { refuse_line(file_, line_.number, what); }
    // Whether the line begins a part of the file.
    bool begins_part(std::string_view line);
    void take_line(std::string_view line);
    void take_head(const RestartLine& line);
    void take_species(const RestartLine& line);
    void take_wall(const RestartLine& line);
    void take_boundary(const RestartLine& line);
    void take_grain(const RestartLine& line);
    void take_plain_grain(const std::vector<double>& numbers);
    void add(const char* column, double value);
    void finish();

    LineReader lines_;
    TextLine line_;  // the present line
    Part part_ = Part::head;
    std::int64_t grains_left_ = 0, no_spheres_ = 0;
    std::string grain_word_;       // the first word of the last grain's line
    std::size_t next_column_ = 0;  // next column of the present grain
    bool grains_seen_ = false;
    std::vector<double> densities_;        // by species
    std::map<std::string, int> left_out_;  // number of walls that were left out, by kind
    RawFrame frame_;
    WorldCell box_;
};

MercuryRestart::MercuryRestart(const std::filesystem::path& file) : RawFile(file), lines_(file) {
    facts_.format = "MercuryDPM restart";
    facts_.program = "MercuryDPM";
    while (lines_.next_with_words(line_))
        if (!begins_part(line_.text)) take_line(line_.text);
    if (!grains_seen_) fault("the file ends before its Particles; was it copied or written to the end?");
    if (grains_left_ > 0)
        fault(fmt::format("the file ends {} grains too early; was it copied or written to the end?",
                          grains_left_));
    finish();
}

bool MercuryRestart::begins_part(std::string_view line) {
    const std::string_view word = take_word(line);
    const std::optional<std::int64_t> count = whole_in(take_word(line));
    if (grains_left_ > 0 || !count || !trimmed(line).empty()) return false;
    if (word == "Species")
        part_ = Part::species;
    else if (word == "Walls")
        part_ = Part::walls;
    else if (word == "Boundaries")
        part_ = Part::boundaries;
    else if (word == "Particles")
        part_ = Part::grains;
    else if (word == "Interactions")
        part_ = Part::rest;
    else
        return false;
    if (part_ != Part::grains) return true;
    if (*count < 0) fault("the count of grains is negative");
    grains_left_ = *count;
    grains_seen_ = true;
    return true;
}

void MercuryRestart::take_line(std::string_view text) {
    if (part_ == Part::rest) return;
    if (part_ == Part::grains && grains_left_ == 0) {
        if (frame_.grains.rows > 0 && RestartLine(text).first_word() == grain_word_)
            fault(
                fmt::format("a grain stands behind the {} that the line Particles counts; is that line "
                            "right?",
                            frame_.grains.rows));
        return;
    }
    if (part_ == Part::grains && !line_.ended)
        fault("the file ends within a grain; was it copied or written to the end?");
    const RestartLine line(text);
    switch (part_) {
        case Part::head:
            take_head(line);
            break;
        case Part::species:
            take_species(line);
            break;
        case Part::walls:
            take_wall(line);
            break;
        case Part::boundaries:
            take_boundary(line);
            break;
        case Part::grains:
            take_grain(line);
            break;
        case Part::rest:
            break;
    }
}

void MercuryRestart::take_head(const RestartLine& line) {
    const std::array<std::array<const char*, 2>, 3> ends{
        {{"xMin", "xMax"}, {"yMin", "yMax"}, {"zMin", "zMax"}}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int i = static_cast<int>(axis);
        const std::optional<double> low = line.number(ends[axis][0]), high = line.number(ends[axis][1]);
        if (!low || !high || !(*high >= *low)) continue;
        box_.origin[i] = *low;
        box_.edges[axis][i] = *high - *low;
    }
    if (line.first_word() == "timeStep" || line.first_word() == "dt") {
        frame_.time = line.number("time");
        if (!frame_.time) frame_.time = line.number("t");
        if (const std::optional<double> step = line.number("ntimeSteps"); step && std::abs(*step) < 9e18)
            frame_.step = static_cast<std::int64_t>(*step);
    }
    for (const char* key : {"systemDimensions", "dim"})
        if (line.number(key) == 2.0) facts_.dimensions = 2;
    if (const std::optional<Vec3> gravity = line.vector("gravity")) facts_.gravity = *gravity;
}

// Takes the densities of single species. Entries for two species have no density.
void MercuryRestart::take_species(const RestartLine& line) {
    std::optional<double> density = line.number("density");
    if (!density) density = line.number("rho");
    if (density) densities_.push_back(*density);
}

void MercuryRestart::take_wall(const RestartLine& line) {
    const Quaternion still(1, 0, 0, 0);
    const std::vector<double>* q = line.find("orientation", 4);
    const Quaternion turn = q ? Quaternion((*q)[0], (*q)[1], (*q)[2], (*q)[3]) : still;
    const std::optional<Vec3> position = line.vector("position"), normal = line.vector("normal");
    const std::optional<double> along = line.number("position");
    const std::vector<double>* corners = line.find("vertexInLabFrame", 9);
    RawWall wall{line.first_word(), {}, {}};
    if (wall.name == "InfiniteWall" && normal && along) {
        wall.mesh = plane_in_box(*normal * *along, *normal, box_);
    } else if (wall.name == "InfiniteWall" && position && (normal || q)) {
        wall.mesh = plane_in_box(*position, normal ? *normal : turn * Vec3::UnitX(), box_);
    } else if (wall.name == "TriangleWall" && position && corners) {
        for (std::size_t i = 0; i < 9; i += 3)
            wall.mesh.vertices.push_back(*position +
                                         turn * Vec3((*corners)[i], (*corners)[i + 1], (*corners)[i + 2]));
        wall.mesh.triangles.push_back({0, 1, 2});
    }
    if (wall.mesh.empty()) {
        ++left_out_[wall.name];
        return;
    }
    wall.name = fmt::format("wall {}", frame_.walls.size());
    frame_.walls.push_back(std::move(wall));
}

void MercuryRestart::take_boundary(const RestartLine& line) {
    if (line.first_word().find("PeriodicBoundary") == std::string::npos) return;
    const std::optional<Vec3> normal = line.vector("normal");
    if (!normal) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::abs((*normal)[static_cast<int>(axis)]) > 1 - 1e-9) box_.periodic[axis] = true;
}

void MercuryRestart::add(const char* name, double value) {
    RawTable& grains = frame_.grains;
    if (next_column_ == grains.columns.size()) {
        if (grains.rows > 0) fault(fmt::format("this grain has a value more than those before: {}", name));
        grains.columns.push_back({name, {}, {}});
    }
    const bool place = std::string_view(name).size() == 1;
    if (place && !std::isfinite(value)) fault(fmt::format("the grain has no place: its {} is none", name));
    grains.columns[next_column_++].values.push_back(value);
}

void MercuryRestart::take_plain_grain(const std::vector<double>& numbers) {
    if (numbers.size() < plain_columns.size())
        fault(fmt::format("this grain has {} numbers; of restart_version 3 they are {} at least",
                          numbers.size(), plain_columns.size()));
    for (std::size_t i = 0; i < plain_columns.size(); ++i)
        if (*plain_columns[i] != '\0') add(plain_columns[i], numbers[i]);
}

void MercuryRestart::take_grain(const RestartLine& line) {
    --grains_left_;
    next_column_ = 0;
    grain_word_ = line.first_word();
    if (grain_word_.find("SuperQuadric") != std::string::npos) ++no_spheres_;
    if (!line.find("position", 3)) {
        take_plain_grain(line.first_numbers());
    } else {
        for (const Field& field : fields_of_keys()) {
            const std::vector<double>* numbers = line.find(field.key, field.columns.size());
            for (std::size_t i = 0; i < field.columns.size(); ++i)
                add(field.columns[i], numbers ? (*numbers)[i] : kUnknown);
        }
    }
    ++frame_.grains.rows;
}

void MercuryRestart::finish() {
    RawTable& grains = frame_.grains;
    if (const RawColumn* species = grains.find("species"); species && !densities_.empty()) {
        RawColumn density{"density", {}, {}};
        for (const double one : species->values) {
            const bool known = one >= 0 && one < static_cast<double>(densities_.size());
            density.values.push_back(known ? densities_[static_cast<std::size_t>(one)] : kUnknown);
        }
        grains.columns.push_back(std::move(density));
    }
    frame_.box = box_;
    if (no_spheres_ > 0)
        news_.push_back(
            fmt::format("{}: has grains that are no spheres ({} superquadrics); they are drawn as "
                        "spheres",
                        file_.string(), no_spheres_));
    for (const auto& [kind, count] : left_out_)
        news_.push_back(fmt::format("{}: {} wall{} of the kind {} cannot be drawn and {} left out",
                                    file_.string(), count, count == 1 ? "" : "s", kind,
                                    count == 1 ? "is" : "are"));
    RawMoment moment;
    moment.time = frame_.time;
    moment.step = frame_.step;
    moment.grains = static_cast<std::int64_t>(grains.rows);
    moment.has_walls = !frame_.walls.empty();
    moments_.push_back(moment);
}

bool takes_mercury_restart(const FileStart& head) {
    const std::string_view bytes = head.bytes;
    return !head.folder && (bytes.starts_with("MercuryDPM ") || bytes.starts_with("restart_version "));
}

std::unique_ptr<RawFile> open_mercury_restart(const std::filesystem::path& file) {
    return std::make_unique<MercuryRestart>(file);
}

}  // namespace

RawFormat mercury_restart_format() {
    return {"mercury-restart", "state and walls of MercuryDPM (.restart)", takes_mercury_restart,
            open_mercury_restart};
}

}  // namespace grainreel
