// Reads GSD files of HOOMD-blue with the schema "hoomd". The chunks are read by gsd_file.hpp. If a frame
// lacks a chunk, that of frame 0 is used. If the number of grains is another there, the schema has defaults;
// a diameter of 1 m, a mass of 1 kg and grains at rest are no facts of such a frame, and stay unknown.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/files/foreign/gsd/gsd_file.hpp"
#include "engine/files/foreign/gsd/gsd_shapes.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

namespace {

constexpr std::string_view of_particles = "particles/", of_log = "log/",
                           of_logged_particles = "log/particles/";
constexpr std::uint32_t most_columns = 64;  // columns of one chunk

// The schema's default of a component; NaN where it has none that is to be believed.
double default_of(const std::string& name, std::size_t component) {
    static const std::set<std::string> zeros{"typeid", "charge", "angmom", "moment_inertia", "image"};
    if (zeros.count(name) > 0) return 0;
    if (name == "body") return -1;
    if (name == "orientation") return component == 0 ? 1 : 0;
    return kUnknown;
}

std::string column_name(const std::string& name, std::size_t component, std::size_t components) {
    if (name == "position" && component < 3) return std::string(1, "xyz"[component]);
    if (name == "typeid") return "type";
    return components == 1 ? name : fmt::format("{}:{}", name, component);
}

class GsdFrames : public RawFile {
  public:
    explicit GsdFrames(const std::filesystem::path& path);

    RawFrame read(std::size_t index) const override;

  private:
    // The chunk of the frame, or else that of frame 0.
    const GsdChunk* chunk_of(const std::string& name, std::size_t frame) const;
    std::optional<double> scalar(const std::string& name, std::size_t frame) const;
    std::optional<double> time_of(std::size_t frame) const;
    WorldCell box_of(const GsdChunk& chunk) const;
    void add_columns(RawTable& grains, const std::string& name, std::size_t frame) const;
    void add_log(RawTable& grains, const std::string& name, std::size_t frame) const;
    void name_types(RawTable& grains, std::size_t frame) const;
    std::vector<GsdShape> shapes_of(std::size_t frame) const;
    void add_sizes_of_shapes(RawTable& grains, std::size_t frame) const;
    void check_places(const RawFrame& frame, std::size_t index, std::uint64_t byte) const;
    std::int64_t step_of(std::size_t frame) const;
    void tell_of_shapes(const std::string& name);

    GsdFile gsd_;
    std::map<std::string, std::uint32_t> logged_;  // columns of what is logged for each grain, by name
    bool has_ellipsoids_ = false;                  // whether their half lengths are columns
    std::string time_name_;  // name of the chunk with the time; empty where there is none
    mutable std::mutex reading_;
};

GsdFrames::GsdFrames(const std::filesystem::path& path) : RawFile(path), gsd_(path) {
    if (gsd_.schema() != "hoomd")
        throw UserError("{}: a GSD file of the schema \"{}\" is not read; \"hoomd\" is", path.string(),
                        gsd_.schema());
    if (gsd_.frames() == 0) throw UserError("{}: has no frame", path.string());
    facts_.format = "GSD";
    facts_.program = gsd_.application();
    facts_.first_row_id = 0;  // as HOOMD's tags, bonds and groups count
    for (const std::string& name : gsd_.names())
        if (name.starts_with(of_log) && name.ends_with("/time") && time_name_.empty()) time_name_ = name;
    if (scalar("configuration/dimensions", 0).value_or(3) == 2) facts_.dimensions = 2;
    const std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    for (std::size_t frame = 0; frame < gsd_.frames(); ++frame) {
        RawMoment moment;
        const double grains = scalar("particles/N", frame).value_or(0);
        if (!(grains >= 0 && grains <= static_cast<double>(most)))
            throw UserError("{}: frame {} has {} grains", path.string(), frame, grains);
        moment.grains = static_cast<std::int64_t>(grains);
        if (gsd_.has("configuration/step")) moment.step = step_of(frame);
        moment.time = time_of(frame);
        moments_.push_back(moment);
    }
    for (const std::string& name : gsd_.names())
        for (std::size_t frame = 0; frame < gsd_.frames() && name.starts_with(of_logged_particles); ++frame)
            if (const GsdChunk* chunk = gsd_.find(name, frame); chunk && chunk->columns <= most_columns)
                logged_.try_emplace(name, chunk->columns);
    has_ellipsoids_ = draws_ellipsoids(shapes_of(0), gsd_.has("particles/diameter"));
    tell_of_shapes(path.string());
}

std::int64_t GsdFrames::step_of(std::size_t frame) const {
    constexpr double most = 9e15;
    const double step = scalar("configuration/step", frame).value_or(0);
    if (!(std::abs(step) < most))
        gsd_.fault(chunk_of("configuration/step", frame)->place,
                   fmt::format("frame {} has the step {}, which no run reaches", frame, step));
    return static_cast<std::int64_t>(step);
}

std::vector<GsdShape> GsdFrames::shapes_of(std::size_t frame) const {
    std::vector<GsdShape> shapes;
    if (const GsdChunk* chunk = chunk_of("particles/type_shapes", frame))
        for (const std::string& text : gsd_.texts(*chunk)) shapes.push_back(gsd_shape(text));
    return shapes;
}

// Ellipsoids that are drawn as what they are need no line here.
void GsdFrames::tell_of_shapes(const std::string& name) {
    std::set<std::string> others;
    for (const GsdShape& shape : shapes_of(0))
        if (!shape.name.empty() && shape.name != "Sphere" && !shape.is_sphere() &&
            !(has_ellipsoids_ && shape.is_ellipsoid()))
            others.insert(shape.name);
    if (!others.empty())
        news_.push_back(fmt::format("{}: has grains that are no spheres ({}); they are drawn as spheres",
                                    name, fmt::join(others, ", ")));
}

const GsdChunk* GsdFrames::chunk_of(const std::string& name, std::size_t frame) const {
    const GsdChunk* chunk = gsd_.find(name, frame);
    return chunk ? chunk : gsd_.find(name, 0);
}

std::optional<double> GsdFrames::scalar(const std::string& name, std::size_t frame) const {
    const GsdChunk* chunk = chunk_of(name, frame);
    if (!chunk) return std::nullopt;
    if (chunk->rows != 1 || chunk->columns != 1)
        gsd_.fault(chunk->place, fmt::format("{} is not a single number", name));
    return gsd_.numbers(*chunk).front();
}

std::optional<double> GsdFrames::time_of(std::size_t frame) const {
    if (time_name_.empty()) return std::nullopt;
    const GsdChunk* chunk = gsd_.find(time_name_, frame);
    if (!chunk || chunk->rows != 1 || chunk->columns != 1) return std::nullopt;
    const double time = gsd_.numbers(*chunk).front();
    return std::isfinite(time) ? std::optional(time) : std::nullopt;
}

// The box by lengths and by tilts, which are ratios to Ly and Lz. Its middle is at 0.
WorldCell GsdFrames::box_of(const GsdChunk& chunk) const {
    const std::vector<double> n = gsd_.numbers(chunk);
    if (n.size() != 6) gsd_.fault(chunk.place, "configuration/box is not six numbers");
    for (const double number : n)
        if (!std::isfinite(number)) gsd_.fault(chunk.place, "configuration/box has a number that is none");
    WorldCell box;
    box.edges = {Vec3(n[0], 0, 0), Vec3(n[3] * n[1], n[1], 0), Vec3(n[4] * n[2], n[5] * n[2], n[2])};
    box.origin = -0.5 * (box.edges[0] + box.edges[1] + box.edges[2]);
    box.periodic = {true, true, facts_.dimensions == 3};
    return box;
}

void GsdFrames::add_columns(RawTable& grains, const std::string& name, std::size_t frame) const {
    const std::string full = std::string(of_particles) + name;
    const GsdChunk* chunk = chunk_of(full, frame);
    const bool own = gsd_.find(full, frame) != nullptr;
    if (chunk && own && chunk->rows != grains.rows)
        gsd_.fault(chunk->place, fmt::format("{} has {} rows, and the frame has {} grains", full, chunk->rows,
                                             grains.rows));
    const bool whole = chunk && chunk->rows == grains.rows;
    if (!whole && name == "position" && grains.rows > 0)
        gsd_.fault(0, fmt::format("frame {} has {} grains without places", frame, grains.rows));
    static const std::map<std::string, std::size_t> widths{{"position", 3},    {"velocity", 3},
                                                           {"image", 3},       {"angmom", 4},
                                                           {"orientation", 4}, {"moment_inertia", 3}};
    const auto known = widths.find(name);
    const std::size_t width = known != widths.end() ? known->second : whole ? chunk->columns : 1;
    if (whole && chunk->columns != width)
        gsd_.fault(chunk->place,
                   fmt::format("{} has {} columns in place of {}", full, chunk->columns, width));
    if (width > most_columns) return;
    const std::vector<double> values = whole ? gsd_.numbers(*chunk) : std::vector<double>();
    for (std::size_t k = 0; k < width; ++k) {
        RawColumn column{column_name(name, k, width), {}, {}};
        column.values.reserve(grains.rows);
        for (std::size_t i = 0; i < grains.rows; ++i) {
            column.values.push_back(whole ? values[i * width + k] : default_of(name, k));
            if (name == "position" && !std::isfinite(column.values.back()))
                gsd_.fault(chunk->place, fmt::format("grain {} of frame {} has no place", i, frame));
        }
        grains.columns.push_back(std::move(column));
    }
}

// Every frame gets the same columns. A frame that does not have them for each of its grains has NaN there.
void GsdFrames::add_log(RawTable& grains, const std::string& name, std::size_t frame) const {
    const auto known = logged_.find(name);
    if (known == logged_.end()) return;
    const std::size_t width = known->second;
    const GsdChunk* chunk = gsd_.find(name, frame);
    const bool whole = chunk && chunk->rows == grains.rows && chunk->columns == width;
    const std::vector<double> values = whole ? gsd_.numbers(*chunk) : std::vector<double>();
    for (std::size_t k = 0; k < width; ++k) {
        RawColumn column{column_name(name, k, width), {}, {}};
        for (std::size_t i = 0; i < grains.rows; ++i)
            column.values.push_back(whole ? values[i * width + k] : kUnknown);
        grains.columns.push_back(std::move(column));
    }
}

void GsdFrames::name_types(RawTable& grains, std::size_t frame) const {
    const GsdChunk* chunk = chunk_of("particles/types", frame);
    const std::vector<std::string> words = chunk ? gsd_.texts(*chunk) : std::vector<std::string>{"A"};
    for (RawColumn& column : grains.columns) {
        if (column.name != "type") continue;
        for (const double type : column.values)
            if (type >= static_cast<double>(words.size()))
                gsd_.fault(chunk ? chunk->place : 0,
                           fmt::format("frame {} has grains of type {}, and there are "
                                       "{} types",
                                       frame, type, words.size()));
        column.words = words;
    }
}

void GsdFrames::add_sizes_of_shapes(RawTable& grains, std::size_t frame) const {
    const std::vector<GsdShape> shapes = shapes_of(frame);
    if (has_ellipsoids_) {
        add_half_lengths(grains, shapes);
        return;
    }
    const auto says_diameter = [](const GsdShape& one) { return one.name == "Sphere" && one.half; };
    if (!grains.find("diameter") && std::any_of(shapes.begin(), shapes.end(), says_diameter))
        add_diameters(grains, shapes);
}

// The schema has all places in the box. One that is far outside of it is damage. byte: where the places are.
void GsdFrames::check_places(const RawFrame& frame, std::size_t index, std::uint64_t byte) const {
    constexpr double far = 10;  // times the box's own reach
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        const RawColumn* column = frame.grains.find(name);
        double reach = 0;
        for (const Vec3& edge : frame.box->edges)
            reach += 0.5 * std::abs(edge[static_cast<Eigen::Index>(axis)]);
        for (std::size_t i = 0; column && reach > 0 && i < frame.grains.rows; ++i)
            if (std::abs(column->values[i]) > far * reach)
                gsd_.fault(byte,
                           fmt::format("grain {} of frame {} has {} = {:.3g}, far outside of the box; is "
                                       "the file damaged?",
                                       i, index, name, column->values[i]));
    }
}

RawFrame GsdFrames::read(std::size_t index) const {
    const std::lock_guard lock(reading_);
    RawFrame frame;
    frame.step = moments_.at(index).step;
    frame.time = moments_[index].time;
    frame.grains.rows = static_cast<std::size_t>(moments_[index].grains);
    if (const GsdChunk* box = chunk_of("configuration/box", index)) frame.box = box_of(*box);
    const GsdChunk* places = chunk_of("particles/position", index);
    if (frame.grains.rows > 0 && (!places || places->rows != frame.grains.rows))
        gsd_.fault(places ? places->place : 0,
                   fmt::format("frame {} has {} grains and no places for them", index, frame.grains.rows));
    for (const std::string& name : gsd_.names()) {
        if (name.starts_with(of_logged_particles)) add_log(frame.grains, name, index);
        if (!name.starts_with(of_particles) || !gsd_.has(name)) continue;
        const std::string own = name.substr(of_particles.size());
        if (own != "N" && own != "types" && own != "type_shapes") add_columns(frame.grains, own, index);
    }
    if (!frame.grains.find("type") && gsd_.has("particles/types"))
        frame.grains.columns.push_back({"type", std::vector<double>(frame.grains.rows, 0.0), {}});
    if (frame.box && places) check_places(frame, index, places->place);
    name_types(frame.grains, index);
    add_sizes_of_shapes(frame.grains, index);
    return frame;
}

bool takes_gsd(const FileStart& head) {
    constexpr std::string_view magic = "\xdf\x65\xdf\x65\xdf\x65\xdf\x65";
    return std::string_view(head.bytes).starts_with(magic);
}

std::unique_ptr<RawFile> open_gsd(const std::filesystem::path& file) {
    return std::make_unique<GsdFrames>(file);
}

}  // namespace

RawFormat gsd_format() {
    return {"gsd", "GSD of HOOMD-blue", takes_gsd, open_gsd};
}

}  // namespace grainreel
