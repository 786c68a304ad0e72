#include "engine/run/import/import_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/rotation.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

void write_import_text(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw RunError("{}: cannot be written; is the disk full?", file.string());
}

namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') out += '\\';
        if (byte >= 0x20 && byte != 0x7f) out += c;
    }
    return out + "\"";
}

std::string number(double value) {
    const std::string text = fmt::format("{}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string triple(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

std::string species_text(const ForeignArchive& archive, const ImportSurvey& survey,
                         std::vector<std::string>& news) {
    std::string text;
    constexpr double kLightest = 10, kHeaviest = 30000;  // kg/m3: aerogel, and more than osmium
    bool guessed = false, doubted = false;
    for (std::size_t s = 0; s < archive.world().species.size(); ++s) {
        const WorldSpecies& species = archive.world().species[s];
        const bool known = std::isfinite(species.density) && species.density > 0;
        guessed = guessed || !known;
        doubted = doubted || (known && !(species.density >= kLightest && species.density <= kHeaviest));
        const ImportSurvey::Species& seen = survey.species[s];
        const double small = seen.smallest > 0 ? seen.smallest : 1e-3;
        const double large = seen.largest > 0 ? seen.largest : 1e-3;
        text += fmt::format("\n[[species]]\nname = {}\ncount = {}\n", quoted(species.name),
                            std::max<std::int64_t>(1, seen.most));
        text += large - small <= 1e-9 * large
                    ? fmt::format("diameter = {}\n", number(large))
                    : fmt::format("diameter = {{ min = {}, max = {} }}\n", number(small), number(large));
        text += fmt::format("density = {}\n", number(known ? species.density : kGlassDensity));
    }
    if (guessed)
        news.push_back(fmt::format(
            "{}: says no density; masses and energies are left out until --density gives it (glass: "
            "{} kg/m3)",
            archive.path().string(), kGlassDensity));
    if (doubted)
        news.push_back(fmt::format(
            "{}: its grains have a density below {} or above {:g} kg/m3, as where units are mixed up; "
            "see --units and --density",
            archive.path().string(), kLightest, kHeaviest));
    return text;
}

// Writes PLY as text with all digits, so that the shape is read back exactly as it is in the trajectory.
void write_ply(const fs::path& file, const TriangleMesh& mesh) {
    std::string text = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.size(), mesh.triangles.size());
    for (const Vec3& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
    for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    write_import_text(file, text);
}

void add_row(std::string& text, double time, const BodyPose& pose) {
    text += fmt::format("{},{},{},{},{},{},{},{}\n", time, pose.place.x(), pose.place.y(), pose.place.z(),
                        pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z());
}

// A name that a [[mesh]] may have: no face of the container, species or other mesh has it. The list of faces
// holds the names that container_faces.cpp gives.
std::string mesh_name(const std::string& wanted, const std::vector<std::string>& taken) {
    std::string bare = wanted;
    std::replace(bare.begin(), bare.end(), '_', ' ');
    constexpr std::array<std::string_view, 10> faces{"wall",       "floor",      "lid",         "left wall",
                                                     "right wall", "left slant", "right slant", "back",
                                                     "front",      "tray"};
    const bool face = bare.find_first_not_of(' ') == std::string::npos || bare.starts_with("tray ") ||
                      contains(faces, bare);
    const std::string base = face ? wanted + " of the files" : wanted;
    std::string name = base;
    for (int k = 2; contains(taken, name); ++k) name = fmt::format("{} {}", base, k);
    return name;
}

// The rows of a file with a wall's motion: the pose at each moment, and more rows between moments so that no
// rotation from row to row is larger than a radian and a path has its four rows. Before the first moment the
// wall stands still.
std::string path_text(const ForeignArchive& archive, std::size_t wall) {
    constexpr double largest = 1;  // rad
    const std::vector<State>& moments = archive.moments();
    std::string text = "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n";
    const BodyPose first = moments.front().body(kFirstPlaneBody + wall);
    const int least = moments.size() == 2 ? 3 : moments.size() == 3 ? 2 : 1;  // parts of an interval
    if (moments.front().time > 0) add_row(text, 0, first);
    add_row(text, moments.front().time, first);
    for (std::size_t k = 1; k < moments.size(); ++k) {
        const BodyPose from = moments[k - 1].body(kFirstPlaneBody + wall),
                       to = moments[k].body(kFirstPlaneBody + wall);
        const double begin = moments[k - 1].time, end = moments[k].time;
        if (!(end > begin)) continue;
        const int parts =
            std::max(least, static_cast<int>(1 + angle_between(from.rotation, to.rotation) / largest));
        for (int part = 1; part < parts; ++part) {
            const double share = static_cast<double>(part) / parts;
            BodyPose between;
            between.rotation = rotation_between(from.rotation, to.rotation, share);
            between.place = from.place + share * (to.place - from.place);
            add_row(text, begin + share * (end - begin), between);
        }
        add_row(text, end, to);
    }
    return text;
}

// Whether the file of a motion can be read back. news: gets the reason if not.
bool is_smooth(const fs::path& file, const std::string& wall, std::vector<std::string>& news) {
    try {
        MotionPath::read(file);
        return true;
    } catch (const UserError& why) {
        news.push_back(fmt::format(
            "{}: its motion cannot be followed, and it stands where it was at first ({})", wall, why.what()));
        return false;
    }
}

// The scene's gravity and the tables for its walls and their motions, taken from the scene's text.
std::string walls_and_drive(const std::string& text) {
    std::string kept;
    bool keep = false;
    std::size_t from = 0;
    while (from < text.size()) {
        const std::size_t to = std::min(text.find('\n', from), text.size() - 1);
        const std::string line = text.substr(from, to - from + 1);
        from = to + 1;
        if (line.front() == '[') {
            const std::size_t name = line.find_first_not_of('[');
            const std::string table = line.substr(name, line.find(']') - name);
            const std::string head = table.substr(0, table.find('.'));
            keep = head == "container" || head == "drive" || head == "wall" || head == "mesh";
        } else if (line.rfind("gravity", 0) == 0 && kept.find("gravity") == std::string::npos) {
            kept = line + kept;
            continue;
        }
        if (keep) kept += line;
    }
    return kept;
}

// The volume (m3) of all grains in the tables of species. For a spread of diameters it uses the mean of d^3.
double solid_of(const ImportSurvey& survey) {
    double solid = 0;
    for (const ImportSurvey::Species& species : survey.species) {
        const double a = species.smallest, b = species.largest;
        solid += static_cast<double>(species.most) * std::numbers::pi / 24 * (a + b) * (a * a + b * b);
    }
    return solid;
}

// The box around all grains. It is made larger if they lie closer than a scene may pack them. Nothing is
// packed here; the box only tells the camera what to show.
std::string region_text(const ImportSurvey& survey) {
    constexpr double most_solid = 0.5;  // a scene may have up to 0.55
    const Vec3 low = survey.lowest(), high = survey.highest();
    const Vec3 size = (high - low).cwiseMax(Vec3::Constant(1e-9));
    const double solid = solid_of(survey) / (most_solid * size.prod());
    const double grown = std::max(1e-9, 0.5 * (math::cbrt(solid) - 1));
    const Vec3 margin = grown * size;
    return fmt::format("region = {{ low = {}, high = {} }}\n", triple(low - margin), triple(high + margin));
}

// Whether the grains are discs in a plane: all lie within the thickness of the largest one.
bool is_flat(const ImportSurvey& survey) {
    double largest = 0;
    for (const ImportSurvey::Species& species : survey.species) largest = std::max(largest, species.largest);
    return largest > 0 && survey.high.z() - survey.low.z() <= (1 + 1e-9) * largest;
}

// The tables for the film: a picture for each frame, and no words for what the files do not say, such as
// times or the direction of gravity. A flat bed is seen from above.
std::string film_text(const ForeignArchive& archive, const ImportSurvey& survey, bool has_container) {
    const std::vector<State>& moments = archive.moments();
    const double span = moments.back().time - moments.front().time;
    const double interval =
        moments.size() > 1 ? span / static_cast<double>(moments.size() - 1) : 1 / kUntimedRate;
    std::string text = fmt::format("\n[film]\nrate = {}\n", kUntimedRate);
    if (!archive.world().time_known)
        text += "show = [\"title\", \"legend\", \"scale\", \"counts\", \"captions\"]\n";
    else if (!has_container)
        text +=
            "show = [\"title\", \"legend\", \"time\", \"playback\", \"scale\", \"counts\", \"captions\"]\n";
    if (!has_container && moments.size() > 0 && is_flat(survey))
        text += "\n[film.camera]\nazimuth = -90\nelevation = 90\n";
    text += fmt::format("\n[[film.segment]]\nplayback = {}\n", number(interval * kUntimedRate));
    return text;
}

}  // namespace

namespace {

bool has_own_masses(const State& frame, const StoredWorld& world) {
    constexpr double hair = 1e-6;  // numbers of single precision differ by less
    State spheres;
    spheres.radius = frame.radius;
    for (std::size_t i = 0; i < frame.mass.size(); ++i) {
        const double usual = mass_of(spheres, i, world.species[frame.species[i]].density);
        if (!(std::abs(frame.mass[i] - usual) <= hair * usual)) return true;
    }
    return false;
}

}  // namespace

void ImportSurvey::add(const State& frame, const std::vector<std::string>& types, const StoredWorld& world) {
    masses = masses || has_own_masses(frame, world);
    // A new type may come between two others.
    std::vector<Species> now;
    for (const std::string& type : types) {
        const auto known = std::find_if(species.begin(), species.end(),
                                        [&](const Species& one) { return one.type == type; });
        now.push_back(known != species.end() ? *known : Species{type});
    }
    if (!now.empty()) species = std::move(now);
    std::vector<std::int64_t> count(species.size(), 0);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto s = static_cast<std::size_t>(frame.species[i]);
        const double diameter = 2 * frame.radius[i];
        Species& one = species[s];
        one.smallest = one.smallest > 0 ? std::min(one.smallest, diameter) : diameter;
        one.largest = std::max(one.largest, diameter);
        low = low.cwiseMin(frame.position[i] - frame.radius[i] * Vec3::Ones());
        high = high.cwiseMax(frame.position[i] + frame.radius[i] * Vec3::Ones());
        ++count[s];
    }
    for (std::size_t s = 0; s < species.size(); ++s) species[s].most = std::max(species[s].most, count[s]);
    // Most frames have the same grains as the frame before.
    if (ids == frame.id) return;
    std::vector<std::int32_t> both;
    std::set_union(ids.begin(), ids.end(), frame.id.begin(), frame.id.end(), std::back_inserter(both));
    ids = std::move(both);
    places = std::max(places, ids.size());
}

bool ImportSurvey::within(const ImportSurvey& all, bool box) const {
    if (places > all.places || (masses && !all.masses) || species.size() != all.species.size()) return false;
    for (std::size_t s = 0; s < species.size(); ++s) {
        const Species &one = species[s], &other = all.species[s];
        if (one.type != other.type || one.largest > other.largest) return false;
        if (one.largest > 0 && one.smallest < other.smallest) return false;
        if (box && one.most > other.most) return false;
    }
    return !box || ((low - all.low).minCoeff() >= 0 && (all.high - high).minCoeff() >= 0);
}

ImportWalls write_import_walls(const fs::path& folder, const ForeignArchive& archive,
                               const ReadingOptions& options, std::vector<std::string>& news) {
    ImportWalls text;
    if (!options.container.empty()) {
        const Scene scene = read_scene(options.container, {}, measurable_in);
        const std::string kept = walls_and_drive(written_scene(scene)) + "\n";
        // Gravity may also be a list in brackets.
        const std::size_t line = kept.find("\n[");
        const std::size_t tables = kept.front() == '['         ? 0
                                   : line == std::string::npos ? kept.size()
                                                               : line + 1;
        text.top = kept.substr(0, tables);
        text.tables = "\n" + kept.substr(tables);
    } else {
        text.tables = "\n[container]\nshape = \"none\"\n";
    }
    std::vector<std::string> names;
    for (const WorldSpecies& species : archive.world().species) names.push_back(species.name);
    for (std::size_t w = 0; w < archive.walls().size(); ++w) {
        const MovingWall& wall = archive.walls()[w];
        const std::string file = fmt::format("wall_{}.ply", w), path = fmt::format("wall_{}_path.csv", w);
        write_ply(folder / file, wall.shape);
        const std::string name = mesh_name(wall.name, names);
        names.push_back(name);
        text.tables += fmt::format("\n[[mesh]]\nname = {}\nfile = {}\n", quoted(name), quoted(file));
        bool moves = wall.moves && archive.moments().size() > 1;
        if (moves) {
            write_import_text(folder / path, path_text(archive, w));
            moves = is_smooth(folder / path, wall.name, news);
        }
        if (moves) text.tables += fmt::format("path = {}\n", quoted(path));
    }
    return text;
}

std::string import_scene_text(const ForeignArchive& archive, const ImportSurvey& survey,
                              const ReadingOptions& options, const ImportWalls& walls,
                              std::vector<std::string>& news) {
    const std::vector<State>& moments = archive.moments();
    const State& one = moments.back().step != 0 ? moments.back() : moments.front();
    const double step = one.step != 0 && one.time != 0 ? one.time / static_cast<double>(one.step) : 1e-6;
    // The container may be fuller than what can be packed, because a start from a file is not checked.
    const std::string start =
        options.container.empty() ? region_text(survey) : "method = \"file\"\nfile = \"final.csv\"\n";
    return fmt::format("# Made of {} ({}): what its files say, and nothing that could be run.\ntitle = {}\n",
                       archive.path().string(), archive.format(), quoted(archive.world().title)) +
           walls.top + species_text(archive, survey, news) + walls.tables +
           fmt::format("\n[start]\n{}\n[run]\nduration = {}\nstep = {}\n", start,
                       number(std::max(moments.back().time, step)), number(step)) +
           film_text(archive, survey, !options.container.empty());
}

}  // namespace grainreel
