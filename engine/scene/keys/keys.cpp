#include "engine/scene/keys/keys.hpp"

#include "engine/scene/keys/key_parts.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

using namespace keys;

void add_species(Keys& keys) {
    keys.push_back(
        entry("title", KeyKind::text, note("the file's name"), "Shown on the film unless it has its own."));
    keys.push_back(of_dimension(entry("gravity", KeyKind::gravity, literal("9.81"),
                                      "Downwards along -z; or a vector [x, y, z]; 0 for none."),
                                Dimension::acceleration, not_negative));
    keys.push_back(
        entry("species[].name", KeyKind::text, required(), "For the legend and for [[contact.pair]]."));
    keys.push_back(
        integer("species[].count", 1, most_grains, note("required, but for [[grain]]"), "How many grains."));
    keys.push_back(of_dimension(entry("species[].diameter", KeyKind::diameter, required(),
                                      "One length, or a spread: { min, max } or { mean, deviation }."),
                                Dimension::length, positive));
    keys.push_back(quantity("species[].diameter.min", Dimension::length, positive, note("none"),
                            "Smallest of evenly spread diameters."));
    keys.push_back(
        quantity("species[].diameter.max", Dimension::length, positive, note("none"), "Largest of them."));
    keys.push_back(quantity("species[].diameter.mean", Dimension::length, positive, note("none"),
                            "Mean of normally spread diameters."));
    keys.push_back(quantity("species[].diameter.deviation", Dimension::length, positive, note("none"),
                            "Their standard deviation; cut off at two of them."));
    keys.push_back(quantity("species[].density", Dimension::density, positive, note("required, or `mass`"),
                            "Of the solid."));
    keys.push_back(quantity("species[].mass", Dimension::mass, positive, note("none"),
                            "Of a grain of mean diameter, instead of the density."));
    keys.push_back(entry("species[].colour", KeyKind::colour, note("the next Okabe-Ito colour that is free"),
                         "\"#rrggbb\" or a name: black, white, grey, orange, sky-blue, green, yellow, blue, "
                         "vermilion, purple."));
}

// The numbers of one kind of contact; `inherited` words where the default comes from for walls and pairs.
void add_pair_keys(Keys& keys, const std::string& table, const char* inherited) {
    const auto fallback = [&](Fallback own) { return inherited == nullptr ? own : note(inherited); };
    const auto add = [&](const char* name, Dimension dimension, const Range& range, Fallback own,
                         const char* about) {
        keys.push_back(quantity(table + "." + name, dimension, range, fallback(std::move(own)), about));
    };
    add("restitution", Dimension::number, share, literal("0.9"),
        "Speed after over speed before a normal impact.");
    add("restitution_speed", Dimension::speed, positive, note("none: the same at any speed"),
        "walton-braun only: the speed at which `restitution` holds; slower impacts lose less, faster ones "
        "more.");
    keys.push_back(
        of_dimension(entry(table + ".restitution_table", KeyKind::speed_table,
                           note(inherited == nullptr ? "none" : inherited),
                           "walton-braun only, instead: [speed, restitution] by rising speed, at most "
                           "8 rows; straight lines between them, constant beyond."),
                     Dimension::speed, any));
    add("friction", Dimension::number, not_negative_or_infinite, literal("0.5"),
        "Coulomb's µ; 0 for none, inf to never slip.");
    add("rolling_friction", Dimension::number, not_negative, literal("0"),
        "Torque against rolling, at most so much x effective radius x normal force; 0 for none.");
    add("stiffness", Dimension::stiffness, positive, note("chosen by the plan"),
        "Of the loading branch: K1 (walton-braun) or kn (spring-dashpot).");
    add("modulus", Dimension::pressure, positive, note("chosen by the plan"),
        "hertz only: E* of the pair, 1/E* = (1 - ν²)/E + the same of the other body.");
    add("tangential_ratio", Dimension::number, {0, 1000, true, false},
        note("0.8; linear-spring 2/7, mindlin 0.824"),
        "Tangential over normal stiffness; of mindlin 2(1 - ν)/(2 - ν).");
    add("gamma", Dimension::number, {0, 100, false, false}, note("1/3"),
        "Exponent of incremental-slip: 1/3 resembles Mindlin, 1 or 2 plastic contacts.");
    add("normal_damping", Dimension::rate, not_negative, note("from the restitution"),
        "spring-dashpot only, instead of the restitution: force = value x effective mass x speed.");
    add("tangential_damping", Dimension::rate, not_negative, note("half the normal damping"),
        "spring-dashpot with linear-spring only.");
    keys.push_back(entry(table + ".attraction", KeyKind::flag, fallback(literal("false")),
                         "spring-dashpot, hertz: the dashpot may pull at the end of contact."));
    keys.push_back(
        of_choices(entry(table + ".law", KeyKind::choice, fallback(literal("\"walton-braun\"")),
                         "Normal force: latching spring; linear spring with a dashpot; Hertz with one."),
                   all_of(normal_law_words)));
    keys.push_back(of_choices(
        entry(table + ".friction_law", KeyKind::choice,
              fallback(note("incremental-slip; linear-spring for spring-dashpot, mindlin for hertz")),
              "Tangential force; none leaves out friction, spin and torque."),
        all_of(tangential_law_words)));
}

void add_contact(Keys& keys) {
    keys.push_back(choice("contact.arms", {"contact-plane", "radius"}, literal("\"contact-plane\""),
                          "Lever arms of the tangential force; radius loses angular momentum."));
    add_pair_keys(keys, "contact", nullptr);
    add_pair_keys(keys, "contact.wall", "as in [contact]");
    keys.push_back(entry("contact.pair[].between", KeyKind::species_pair, required(),
                         "Two names of species, or one and \"wall\"."));
    add_pair_keys(keys, "contact.pair[]", "as in [contact] or [contact.wall]");
}

void add_container(Keys& keys) {
    keys.push_back(choice(
        "container.shape", {"wedge", "box", "cylinder", "none"}, required(),
        "none: empty space. The origin is the middle of the floor; x along the depth, y across, z up."));
    keys.push_back(
        quantity("container.height", Dimension::length, positive, required(), "Floor to lid or rim."));
    keys.push_back(quantity("container.depth", Dimension::length, positive, note("required; wedge, box"),
                            "Front to back, along x."));
    keys.push_back(quantity("container.half_width", Dimension::length, positive, note("required; wedge"),
                            "At and above the slanted part, from the middle to the wall."));
    keys.push_back(quantity("container.half_angle", Dimension::angle, positive, note("required; wedge"),
                            "Between slanted wall and the vertical."));
    keys.push_back(quantity("container.slant_height", Dimension::length, positive, note("required; wedge"),
                            "Height of the slanted part."));
    keys.push_back(
        quantity("container.width", Dimension::length, positive, note("required; box"), "Along y."));
    keys.push_back(
        quantity("container.diameter", Dimension::length, positive, note("required; cylinder"), "Inside."));
    keys.push_back(choice("container.top", {"lid", "open"}, literal("\"lid\""), "Sealed, or open above."));
    keys.push_back(entry("container.outlet", KeyKind::text, literal("\"closed\""),
                         "Only \"closed\": open outlets are not modelled yet."));
    keys.push_back(entry("container.periodic_depth", KeyKind::flag, literal("false"),
                         "No front and back walls: what leaves at one enters at the other."));
}

void add_exact(Keys& keys) {
    const auto vector = [&](const char* path, Dimension dimension, Fallback fallback, const char* about) {
        keys.push_back(
            of_dimension(entry(path, KeyKind::vector, std::move(fallback), about), dimension, any));
    };
    keys.push_back(entry("wall[].name", KeyKind::text, note("wall 1, wall 2, ..."),
                         "A plane anywhere, beside the container's faces or without any; for messages."));
    vector("wall[].point", Dimension::length, required(), "Any point of it.");
    vector("wall[].normal", Dimension::number, required(), "Towards the grains; any length.");
    vector("wall[].velocity", Dimension::speed, literal("[0, 0, 0]"), "Steady, from the start.");
    keys.push_back(entry("wall[].moves", KeyKind::flag, literal("false"), "Follows the drive as well."));
    keys.push_back(entry("grain[].species", KeyKind::text, note("the first"),
                         "Grains placed one by one; whose numbers it has."));
    vector("grain[].position", Dimension::length, required(), "Of the centre.");
    vector("grain[].velocity", Dimension::speed, literal("[0, 0, 0]"), "At the start.");
    vector("grain[].spin", Dimension::spin, literal("[0, 0, 0]"), "Angular velocity at the start.");
    keys.push_back(quantity("grain[].diameter", Dimension::length, positive, note("the species' mean"),
                            "Inside the species' spread."));
}

void add_drive(Keys& keys) {
    keys.push_back(quantity("drive.frequency", Dimension::frequency, positive, required(), "f."));
    keys.push_back(quantity("drive.g_level", Dimension::number, {0, 1e6, true, false},
                            note("required, or `amplitude`"), "Γ = a (2πf)² / g."));
    keys.push_back(quantity("drive.amplitude", Dimension::length, positive_or_tiny, note("from `g_level`"),
                            "a, half of the stroke."));
    keys.push_back(
        entry("drive.direction", KeyKind::vector, literal("[0, 0, 1]"), "Of the motion; any length."));
    keys.push_back(
        quantity("drive.phase", Dimension::phase, any, literal("0"),
                 "Of the sine at t = 0, \"90 deg\" or 0.25 turns; beyond one turn with a unit only."));
    keys.push_back(quantity("drive.ramp", Dimension::number, not_negative, literal("3"),
                            "Periods over which the amplitude grows: 3 or more, or 0 for a sudden start."));
    keys.push_back(
        choice("drive.moves", {"container", "floor"}, literal("\"container\""), "What oscillates."));
}

void add_run(Keys& keys) {
    keys.push_back(choice("start.method", {"layers", "file", "grains"}, note("layers; grains with [[grain]]"),
                          "Grow and settle layers in the room before all planes, the first species of the "
                          "largest grains at the bottom; go "
                          "on from a file; or the grains as listed, at once."));
    keys.push_back(entry("start.file", KeyKind::text, note("required; file"),
                         "Checkpoint or final.csv of an earlier run, relative to the scene's folder."));
    keys.push_back(entry("start.keep_clock", KeyKind::flag, literal("false"),
                         "Go on at the checkpoint's step and phase; file only."));
    keys.push_back(quantity("start.settle_limit", Dimension::time, positive, literal("\"5 s\""),
                            "Settling ends here at the latest; layers only."));
    keys.push_back(quantity("start.settle_damping", Dimension::rate, not_negative, literal("\"10 1/s\""),
                            "Drag on every grain while settling only; layers only."));
    keys.push_back(quantity("run.duration", Dimension::time, positive, literal("\"10 s\""),
                            "Of vibration; without a drive, of simulated time."));
    keys.push_back(integer("run.seed", 0, 9007199254740992.0, literal("1"), "Of every random choice."));
    keys.push_back(integer("run.threads", 0, 1024, literal("0"), "0: as many as the machine gives."));
    keys.push_back(
        choice("run.accuracy", all_of(accuracy_words), literal("\"standard\""),
               "Defaults of overlap and steps a contact: 2 % and 0.7 times, 1 % and once, 0.3 % and "
               "4 times; docs/reference/accuracy.md has the errors."));
    keys.push_back(quantity("run.step", Dimension::time, positive, note("chosen by the plan"),
                            "With a drive shortened so that a multiple of 8 steps makes a period."));
    keys.push_back(quantity("run.overlap", Dimension::number, {0, 0.1, true, false},
                            note("0.01; by `accuracy`"),
                            "Wanted largest overlap over the smaller diameter; sets the stiffness."));
    keys.push_back(choice("run.integrator", all_of(integrator_words), literal("\"velocity-verlet\""),
                          "How a step is made; the others are for comparison."));
    keys.push_back(choice("run.precision", all_of(precision_words), literal("\"double\""),
                          "mixed: contact laws, their histories and relative motion in single precision, all "
                          "else in double; about "
                          "1.25 times as fast."));
    keys.push_back(entry("run.contact_corrections", KeyKind::flag,
                         note("true where possible; false with draft"),
                         "walton-braun of constant restitution up to 0.9976, with velocity-verlet: corrects "
                         "onset, peak and exit of each contact."));
    keys.push_back(integer(
        "run.steps_per_contact", 4, 1000000,
        note("12 or more by restitution; 45 with a dashpot or a restitution above 0.9976; by `accuracy`"),
        "Steps in one free impact."));
    keys.push_back(entry("output.trajectory", KeyKind::flag, literal("true"), "Keep trajectory.nc."));
    keys.push_back(quantity("output.trajectory_interval", Dimension::time, positive,
                            note("one period; 1/30 s without a drive"), "Between its frames."));
    keys.push_back(quantity("output.measures_interval", Dimension::time, positive,
                            note("1/8 period; 10 ms without a drive"), "Between rows of measures.csv."));
    keys.push_back(
        entry("output.orientation", KeyKind::flag, literal("false"), "Orientations in the trajectory."));
    keys.push_back(
        entry("output.contacts", KeyKind::flag, literal("false"), "Contacts and forces in contacts.nc."));
}

}  // namespace

const std::vector<Key>& scene_keys() {
    static const Keys keys = [] {
        Keys all;
        add_species(all);
        add_contact(all);
        add_container(all);
        add_exact(all);
        add_drive(all);
        add_run(all);
        add_film(all);
        return all;
    }();
    return keys;
}

}  // namespace grainreel
