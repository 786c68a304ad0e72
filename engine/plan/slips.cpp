// Values that can be run, but that nobody means: a unit left out, a factor of a thousand, a sign. Each
// warning names the figure and the likely slip.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/plan/plan_parts.hpp"
#include "engine/plan/warnings.hpp"
#include "engine/scene/bed.hpp"

namespace grainreel {

namespace {

// What beds in a laboratory have, with a margin on either side.
constexpr double lightest = 25, densest = 23000;  // kg/m3: beads of foam, osmium
constexpr double finest = 10e-6, coarsest = 0.5;  // m, of a grain
constexpr double largest_container = 20;          // m
constexpr double highest_frequency = 1000;        // Hz
constexpr double hardest = 100;                   // Gamma
constexpr double strongest_gravity = 500;         // m/s2
constexpr double roughest = 3, most_rolling_resistance = 1;

void look_at_density(const Scene& scene, std::size_t index, Warnings& warnings) {
    const std::string table = fmt::format("species[{}]", index);
    const double density = scene.species[index].density;
    if (density >= lightest && density <= densest) return;
    const std::string what = density < lightest ? "less than foam has" : "more than any solid has";
    if (scene.written.count(table + ".mass") > 0) {
        warnings.add(table + ".mass",
                     fmt::format("this mass makes a density of {:.4g} kg/m3, {}; is its unit, "
                                 "or that of the diameter, the one you mean?",
                                 density, what));
        return;
    }
    const double likely = density < lightest ? density : density / 1000;  // g/cm3
    const bool fits = 1000 * likely >= lightest && 1000 * likely <= densest;
    warnings.add(
        table + ".density",
        fmt::format("a density of {:.4g} kg/m3 is {}; a number without a unit is in kg/m3{}", density, what,
                    fits ? fmt::format(": did you mean \"{:.4g} g/cm3\"?", likely) : ""));
}

void look_at_diameter(const Scene& scene, std::size_t index, Warnings& warnings) {
    const SizeSpread& diameter = scene.species[index].diameter;
    const std::string key = fmt::format("species[{}].diameter", index);
    if (diameter.largest > coarsest)
        warnings.add(key, fmt::format("grains of {0:.4g} m are larger than any that are shaken; a number "
                                      "without a unit is in m: did you mean \"{0:.4g} mm\"?",
                                      diameter.largest));
    if (diameter.smallest < finest)
        warnings.add(key,
                     fmt::format("grains of {:.4g} m stick to each other by forces that are not modelled "
                                 "(van der Waals); is its unit the one you mean?",
                                 diameter.smallest));
}

void look_at_container(const Scene& scene, Warnings& warnings) {
    const Container& c = scene.container;
    if (c.shape == Container::Shape::none || c.shape == Container::Shape::mesh) return;
    const bool wedge = c.shape == Container::Shape::wedge, box = c.shape == Container::Shape::box;
    const std::pair<const char*, double> sizes[] = {{"height", c.height},
                                                    {wedge ? "half_width"
                                                     : box ? "width"
                                                           : "diameter",
                                                     wedge ? c.half_width : 2 * c.half_width},
                                                    {"depth", c.depth}};
    for (const auto& [name, size] : sizes) {
        if (size <= largest_container) continue;
        warnings.add(
            fmt::format("container.{}", name),
            fmt::format("{0:.4g} m is larger than any container that is shaken; a number without a unit "
                        "is in m: did you mean \"{0:.4g} mm\"?",
                        size));
        break;  // the other sizes have the same slip
    }
    if (!wedge) return;
    const auto smaller = [](const Species& a, const Species& b) {
        return a.diameter.smallest < b.diameter.smallest;
    };
    const Species& finest_species = *std::min_element(scene.species.begin(), scene.species.end(), smaller);
    const double floor = 2 * c.floor_half_width(), grain = finest_species.diameter.smallest;
    if (floor < grain)
        warnings.add("container.half_width",
                     fmt::format("the floor is {:.4g} m wide, less than the smallest grain, {:.4g} m: grains "
                                 "hang between the slanted walls and none lies on it; raise half_width, or "
                                 "lower half_angle or slant_height, unless you mean a V",
                                 std::max(0.0, floor), grain));
}

void look_at_gravity(const Scene& scene, Warnings& warnings) {
    const double size = scene.gravity.norm();
    if (size > strongest_gravity)
        warnings.add("gravity",
                     fmt::format("a gravity of {0:.4g} m/s2 is {1:.3g} times that of the Earth; a "
                                 "number without a unit is in m/s2: did you mean \"{0:.4g} cm/s2\"?",
                                 size, size / 9.81));
    if (scene.gravity.z() > 0 && scene.container.shape != Container::Shape::none)
        warnings.add(
            "gravity",
            fmt::format("gravity points up, with {:.4g} m/s2 along z: {}; a number alone is downwards",
                        scene.gravity.z(),
                        scene.container.lid ? "the bed will lie under the lid"
                                            : "what is not held above leaves the container"));
}

// `table` is "drive" or the table of a stage.
void look_at_motion(const Scene& scene, const std::string& table, const Drive& motion, Warnings& warnings) {
    if (motion.frequency > highest_frequency)
        warnings.add(
            table + ".frequency",
            fmt::format("{:.4g} Hz is faster than any bed is shaken (5 to 500 Hz), with an amplitude "
                        "of {:.3g} m; did you mean \"{:.4g} Hz\"?",
                        motion.frequency, motion.amplitude, motion.frequency / 1000));
    const bool given = scene.written.count(table + ".amplitude") > 0;
    const std::string key = table + (given ? ".amplitude" : ".g_level");
    const double height = scene.container.height;
    if (scene.container.shape != Container::Shape::none && motion.amplitude > height) {
        const std::string slip =
            given ? fmt::format("a number without a unit is in m: did you mean \"{:.4g} mm\"?",
                                motion.amplitude)
                  : "it follows from frequency and g_level: raise the one or lower the other";
        warnings.add(
            key,
            fmt::format("an amplitude of {:.4g} m is more than the height of the container, {:.4g} m; {}",
                        motion.amplitude, height, slip));
    } else if (const double gamma = motion.g_level(scene.gravity.norm());
               std::isfinite(gamma) && gamma > hardest) {
        warnings.add(key,
                     fmt::format("g_level is {:.4g}, with {:.4g} Hz and an amplitude of {:.4g} m; beds are "
                                 "shaken with 1 to 50: are the units those you mean?",
                                 gamma, motion.frequency, motion.amplitude));
    }
}

void look_at_drive(const Scene& scene, Warnings& warnings) {
    const Drive& drive = scene.drive;
    if (!drive.present) return;
    look_at_motion(scene, "drive", drive, warnings);
    for (std::size_t k = 0; k < drive.stages.size(); ++k) {
        const DriveStage& stage = drive.stages[k];
        if (stage.kind == DriveStage::Kind::rest) continue;
        look_at_motion(scene, fmt::format("drive.stage[{}]", k), {true, stage.frequency, stage.amplitude},
                       warnings);
    }
    const bool replaced = drive.changes() && drive.stages.front().from <= 0;
    if (!replaced && drive.frequency * scene.run.duration < 1)
        warnings.add(
            "drive.frequency",
            fmt::format("one period of {:.4g} s is longer than the run of {:.4g} s; raise the frequency "
                        "or run.duration",
                        1 / drive.frequency, scene.run.duration));
}

// The path of the key `name` in a contact table, if the scene has it just once there; else that of [contact].
std::string place_in_contact(const Scene& scene, const std::string& name) {
    std::vector<std::string> found;
    for (const auto& [path, at] : scene.written)
        if (path.rfind("contact.", 0) == 0 && path.substr(path.rfind('.') + 1) == name) found.push_back(path);
    return found.size() == 1 ? found.front() : "contact";
}

void look_at_friction(const Scene& scene, Warnings& warnings) {
    double friction = 0, rolling = 0;
    for (const auto* pairs : {&scene.contact.grain, &scene.contact.wall, &scene.contact.mesh}) {
        for (const PairContact& pair : *pairs) {
            if (std::isfinite(pair.friction)) friction = std::max(friction, pair.friction);
            rolling = std::max(rolling, pair.rolling_friction);
        }
    }
    if (friction > roughest)
        warnings.add(
            place_in_contact(scene, "friction"),
            fmt::format("a friction of {:.4g} is more than materials have (glass 0.2 to 0.5, rubber "
                        "about 1); {}inf is for grains that never slip",
                        friction,
                        friction <= 100 ? fmt::format("did you mean {:.4g}? ", friction / 100) : ""));
    if (rolling > most_rolling_resistance)
        warnings.add(
            place_in_contact(scene, "rolling_friction"),
            fmt::format("a rolling friction of {:.4g} is more than grains have (sand about 0.1): it is "
                        "the torque over effective radius x normal force; lower it",
                        rolling));
}

}  // namespace

std::vector<std::string> likely_slips(const Scene& scene) {
    Warnings warnings(scene);
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        look_at_density(scene, i, warnings);
        look_at_diameter(scene, i, warnings);
    }
    look_at_container(scene, warnings);
    look_at_gravity(scene, warnings);
    look_at_drive(scene, warnings);
    look_at_friction(scene, warnings);
    return warnings.take();
}

// A stiffness that a run takes over from its start file may be less than its own drive needs.

namespace {

constexpr double alarming_share = 4;  // overlaps are then 2 times as large as wanted, with Hertz 1.7 times

struct Wanted {
    double share = 0;  // wanted stiffness divided by the stiffness there is
    double stiffness = 0, there = 0;
    bool hertz = false;
};

bool is_of_file(const PairPlan& pair) {
    return pair.stiffness_reason.ends_with("start file");
}

// Finds what the plan would choose by itself for this kind of contact, and keeps it in `most` if its share is
// the largest so far.
void look_at(const Scene& scene, const BedPlan& bed, const PairPlan& pair, const PairContact& contact,
             const Species& a, const Species* b, Wanted& most) {
    if (!is_of_file(pair)) return;
    const bool hertz = contact.normal == NormalLaw::hertz;
    const PairPlan own = plan_pair(scene, bed, contact, a, b);
    const double stiffness = hertz ? own.modulus : own.loading_stiffness;
    const double there = hertz ? pair.modulus : pair.loading_stiffness;
    if (stiffness > most.share * there) most = {stiffness / there, stiffness, there, hertz};
}

}  // namespace

std::vector<std::string> start_warnings(const Scene& scene, const Plan& plan, const BedPlan& bed) {
    Warnings warnings(scene);
    if (bed.gravity == 0 && bed.impact_speed == 0) return {};
    Wanted most;
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b < count; ++b)
            look_at(scene, bed, plan.between(a, b), scene.between(a, b), scene.species[a], &scene.species[b],
                    most);
        look_at(scene, bed, plan.wall[a], scene.contact.wall[a], scene.species[a], nullptr, most);
        for (std::size_t m = 0; m < scene.meshes.size(); ++m)
            look_at(scene, bed, plan.at_mesh(m, a), scene.contact.mesh[m * count + a], scene.species[a],
                    nullptr, most);
    }
    if (most.share > alarming_share) {
        const char *name = most.hertz ? "modulus" : "stiffness", *unit = most.hertz ? "Pa" : "N/m";
        warnings.add(
            "start.file",
            fmt::format("the {0} follows from the file and is {1:.3g} {2}, while impacts of {3:.3g} "
                        "m/s want {4:.3g} {2} for overlaps of {5:.2g} %; write contact.{0} = "
                        "\"{4:.3g} {2}\" to have that",
                        name, most.there, unit, bed.impact_speed, most.stiffness, 100 * scene.run.overlap));
    }
    return warnings.take();
}

}  // namespace grainreel
