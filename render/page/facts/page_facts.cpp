#include "render/page/facts/page_facts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/lists.hpp"
#include "engine/scene/text/units.hpp"
#include "render/page/bed/slabs.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

using Json = nlohmann::json;

Json of_vector(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

// The place of a body; for a turned body it is followed by a unit quaternion w, x, y, z.
Json of_pose(const BodyPose& pose) {
    Json numbers = of_vector(pose.place);
    const Quaternion& turn = pose.rotation;
    if (turn.vec().isZero(0)) return numbers;
    for (const double part : {turn.w(), turn.x(), turn.y(), turn.z()})
        numbers.push_back(std::strtod(fmt::format("{:.7f}", part).c_str(), nullptr));
    return numbers;
}

Json of_points(const std::vector<Vec3>& points) {
    Json list = Json::array();
    for (const Vec3& point : points) list.push_back(of_vector(point));
    return list;
}

std::string of_colour(const Colour& colour) {
    const auto byte = [](double part) {
        return static_cast<int>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

// Rounds to six digits, which are more than a chart shows.
double rounded(double value) {
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

constexpr int kRampSteps = 64;

Json ramp(ColourMap map) {
    Json colours = Json::array();
    for (int i = 0; i < kRampSteps; ++i) colours.push_back(of_colour(colour_of(map, i / (kRampSteps - 1.0))));
    return colours;
}

Json slabs_json(const std::vector<Slab>& slabs) {
    Json list = Json::array();
    for (const Slab& slab : slabs) {
        Json one = {{"body", slab.body}, {"inner", of_points(slab.inner)}, {"outer", of_points(slab.outer)}};
        if (!slab.seams.empty()) one["seams"] = slab.seams;
        if (slab.from) one["from"] = *slab.from;
        if (slab.until) one["until"] = *slab.until;
        list.push_back(std::move(one));
    }
    return list;
}

Json meshes_json(const PageMeshes& meshes) {
    Json list = Json::array();
    for (const PageMesh& mesh : meshes.meshes)
        if (mesh.triangles > 0)
            list.push_back({{"body", mesh.body},
                            {"name", mesh.name},
                            {"vertices", mesh.vertices},
                            {"triangles", mesh.triangles},
                            {"glass", mesh.glass},
                            {"sided", mesh.sided},
                            {"edges", mesh.edges},
                            {"low", of_vector(mesh.low)},
                            {"high", of_vector(mesh.high)}});
    return list;
}

Json species_json(const FilmedScene& scene) {
    Json list = Json::array();
    for (std::size_t k = 0; k < scene.species.size(); ++k)
        list.push_back({{"name", scene.species[k].name},
                        {"colour", of_colour(scene.colours[k])},
                        {"hidden", contains(scene.film.shows.hidden, k)},
                        {"ghost", contains(scene.film.shows.ghosts, k)}});
    return list;
}

Json forces_json(const PairForces& forces) {
    if (forces.moments.empty()) return {};
    Json moments = Json::array(), pairs = Json::array();
    for (const PairForces::Moment& one : forces.moments) {
        moments.push_back(one.moment);
        pairs.push_back(one.pairs);
    }
    return {{"moments", moments}, {"pairs", pairs}, {"lowest", forces.lowest}, {"highest", forces.highest}};
}

// The data of the film's colour bar; null when the colours are those of the species.
Json film_colours_json(const FilmedScene& scene, const PageBed& bed) {
    if (!bed.has_film_colours) return {};
    const GrainColouring& colouring = scene.film.shows.colour;
    const ColourScale scale(colouring, scene.film.wording);
    Json colours = Json::array();
    const int bands = scale.bands(), count = bands > 0 ? bands : kRampSteps;
    for (int i = 0; i < count; ++i) colours.push_back(of_colour(scale.at_share((i + 0.5) / count)));
    return {{"title", scale.title()},
            {"low", scale.low() / scale.unit_size()},
            {"high", scale.high() / scale.unit_size()},
            {"unit", colouring.unit},
            {"bands", bands},
            {"logarithmic", scale.logarithmic()},
            {"known", bed.film_coloured},
            {"colours", colours}};
}

Json bed_json(const FilmedScene& scene, const PageBed& bed, const PageMeshes& meshes) {
    const std::vector<Slab> slabs = slabs_of(scene);
    Extent box = box_of(slabs, scene);
    take_turned(box, slabs, bed.moments);
    take_meshes(box, scene, bed.moments);
    Json times = Json::array(), bodies = Json::array();
    for (const State& moment : bed.moments) {
        times.push_back(moment.time);
        Json places = Json::array();
        for (const BodyPose& pose : moment.bodies) places.push_back(of_pose(pose));
        bodies.push_back(std::move(places));
    }
    const Camera& camera = scene.film.camera;
    const bool upright = camera.up == Vec3(0, 0, 1);
    constexpr double usual_field_of_view = 25;  // degrees, used when the film has none (orthographic)
    Json json = {{"grains", bed.grains},
                 {"times", times},
                 {"low", of_vector(bed.low)},
                 {"high", of_vector(bed.high)},
                 {"speed", {{"lowest", bed.lowest_speed}, {"highest", bed.highest_speed}}},
                 {"contacts", bed.counted > 0},
                 {"film", film_colours_json(scene, bed)},
                 {"forces", forces_json(bed.forces)},
                 {"period", scene.container.periodic_depth ? scene.container.depth : 0.0},
                 {"bodies", bodies},
                 {"slabs", slabs_json(slabs)},
                 {"box", {{"low", of_vector(box.low)}, {"high", of_vector(box.high)}}},
                 {"species", species_json(scene)},
                 {"view",
                  {{"azimuth", camera.azimuth},
                   {"elevation", camera.elevation},
                   {"fov", camera.field_of_view > 0 ? camera.field_of_view : usual_field_of_view}}},
                 {"ramps", {{"sequential", ramp(ColourMap::viridis)}, {"diverging", ramp(ColourMap::vik)}}}};
    if (!upright) {
        json["view"]["up"] = of_vector(camera.up);
        json["view"]["front"] = of_vector(front_of(camera.up));
    }
    if (!scene.meshes.empty()) json["meshes"] = meshes_json(meshes);
    return json;
}

Json ramps_json() {
    return {{"sequential", ramp(ColourMap::viridis)}, {"diverging", ramp(ColourMap::vik)}};
}

Json axis_json(const PageFields::Axis& axis) {
    return {{"low", axis.low}, {"cell", axis.cell}, {"count", axis.count}};
}

Json fields_json(const PageFields& fields) {
    if (!fields.present()) return {};
    Json records = Json::array(), quantities = Json::array();
    for (const PageFields::Record& record : fields.records)
        records.push_back(Json::array({record.begin, record.end}));
    for (const FieldQuantity& one : fields.quantities)
        quantities.push_back({{"name", one.name},
                              {"label", one.label},
                              {"unit", one.unit},
                              {"low", one.low},
                              {"high", one.high}});
    return {{"y", axis_json(fields.y)},
            {"z", axis_json(fields.z)},
            {"records", records},
            {"quantities", quantities},
            {"ramps", ramps_json()}};
}

Json column_json(const PageColumn& column) {
    Json json = {{"name", column.name}, {"label", column.label}, {"unit", column.unit}};
    for (const auto& [unit, size] : column.units) json["units"].push_back({{"name", unit}, {"size", size}});
    if (column.smooth) json["smooth"] = true;
    return json;
}

// The wanted columns, with the time as the first one.
Json measures_json(const MeasureTable& table, const PageMeasures& measures,
                   const std::vector<std::size_t>& wanted) {
    std::vector<std::size_t> shown = {measures.time};
    shown.insert(shown.end(), wanted.begin(), wanted.end());
    if (measures.cycles && !contains(wanted, *measures.cycles)) shown.push_back(*measures.cycles);
    Json columns = Json::array(), values = Json::array();
    for (const std::size_t column : shown) {
        columns.push_back(column_json(measures.columns[column]));
        const std::vector<double> all = table.values(column, 0, table.rows());
        Json list = Json::array();
        for (const std::size_t row : measures.rows)
            list.push_back(std::isfinite(all[row]) ? Json(rounded(all[row])) : Json());
        values.push_back(std::move(list));
    }
    return {{"columns", columns}, {"values", values}};
}

Json charts_json(const PageMeasures& measures) {
    Json names = Json::array();
    for (const std::size_t column : measures.charted) names.push_back(measures.columns[column].name);
    return names;
}

Json frequency_json(const Drive& drive) {
    return drive.present && !drive.changes() ? Json(drive.frequency) : Json();
}

std::string text_of_json(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string live_facts_json(const FilmedScene& scene) {
    return text_of_json({{"live", true},
                         {"begin", 0},
                         {"end", scene.run.duration},
                         {"frequency", frequency_json(scene.drive)},
                         {"film", nullptr},
                         {"bed", nullptr},
                         {"measures", nullptr},
                         {"charts", Json::array()}});
}

std::string bed_facts_json(const FilmedScene& scene, const PageBed& bed, const PageMeshes& meshes) {
    return text_of_json(bed_json(scene, bed, meshes));
}

std::string all_measures_json(const MeasureTable& table, const PageMeasures& measures) {
    std::vector<std::size_t> all;
    for (std::size_t column = 0; column < measures.columns.size(); ++column)
        if (column != measures.time) all.push_back(column);
    Json json = measures_json(table, measures, all);
    json["charts"] = charts_json(measures);
    return text_of_json(json);
}

std::string facts_json(const PageFacts& facts) {
    Json json = {
        {"name", facts.name},
        {"folder", facts.folder},
        {"begin", facts.span.from},
        {"end", facts.span.to},
        {"bed", facts.bed.moments.empty() ? Json() : bed_json(facts.scene, facts.bed, facts.meshes)}};
    json["frequency"] = frequency_json(facts.scene.drive);
    json["film"] = facts.film.bytes.empty() ? Json()
                                            : Json{{"type", facts.film.type},
                                                   {"rate", facts.scene.film.rate},
                                                   {"times", facts.film_times.times}};
    json["fields"] = fields_json(facts.fields);
    json["charts"] = Json::array();
    json["columns"] = Json::array();
    json["measures"] = nullptr;
    if (facts.table != nullptr && !facts.measures.rows.empty()) {
        json["measures"] = measures_json(*facts.table, facts.measures, facts.measures.charted);
        json["charts"] = charts_json(facts.measures);
        for (const PageColumn& column : facts.measures.columns)
            json["columns"].push_back(column_json(column));
    }
    return text_of_json(json);
}

}  // namespace grainreel
