// The keys of [run] and [output].

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <vector>

#include "engine/base/lists.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/chapters/words.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "engine/scene/output.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

using namespace keys;

// Whether contact corrections are possible: they need a Walton-Braun spring with constant slopes, and
// velocity Verlet, whose velocities belong to the middle of the step.
bool correctable(const SceneContacts& contact, Integrator integrator) {
    const auto constant = [](const PairContact& pair) {
        return pair.normal == NormalLaw::walton_braun && !pair.restitution_speed &&
               pair.restitution_table.empty();
    };
    return integrator == Integrator::velocity_verlet &&
           (std::any_of(contact.grain.begin(), contact.grain.end(), constant) ||
            std::any_of(contact.wall.begin(), contact.wall.end(), constant));
}

void usual_overlap(Run& run, const Scene&) {
    if (run.accuracy == Accuracy::draft) run.overlap = 0.02;
    if (run.accuracy == Accuracy::reference) run.overlap = 0.003;
}

enum Place { with_time, with_method };  // the order in a written scene

const KeyTable<Run>& run_table() {
    using R = Run;
    static const KeyTable<R> table{
        quantity("duration", &R::duration, Dimension::time, positive, literal("\"10 s\""),
                 "Of vibration; without a drive, of simulated time.")
            .decides_nothing()
            .written_at(with_time),
        integer("seed", &R::seed, 0, 9007199254740992.0, initial(), "Of every random choice.")
            .written_at(with_time),
        integer("threads", &R::threads, 0, 1024, initial(), "0: as many as the machine gives.")
            .decides_nothing()
            .written_at(with_time),
        choice("accuracy", &R::accuracy, accuracy_words, initial(),
               "Defaults of overlap and steps a contact: 2 % and 0.7 times, 1 % and once, 0.3 % and "
               "4 times; docs/reference/accuracy.md has the errors.")
            .written_at(with_method),
        quantity("step", &R::step, Dimension::time, positive, note("chosen by the plan"),
                 "With a drive it is shortened so that a multiple of 8 steps makes a period.")
            .often_chosen()
            .written_at(with_time),
        quantity("overlap", &R::overlap, Dimension::number, {0, 0.1, true, false},
                 note("0.01; by `accuracy`"),
                 "Wanted largest overlap, divided by the smaller diameter; sets the stiffness.")
            .usually(usual_overlap)
            .written_at(with_method),
        choice("integrator", &R::integrator, integrator_words, initial(),
               "How a step is made; the others are for comparison.")
            .written_at(with_method),
        choice("precision", &R::precision, precision_words, initial(),
               "mixed: contact laws, their histories and relative motion in single precision, all "
               "else in double; about 1.25 times as fast.")
            .written_at(with_method),
        flag("contact_corrections", &R::contact_corrections, note("true where possible; false with draft"),
             "walton-braun of constant restitution up to 0.9976, with velocity-verlet: corrects "
             "onset, peak and exit of each contact.")
            .usually([](R& run, const Scene& scene) {
                run.contact_corrections =
                    correctable(scene.contact, run.integrator) && run.accuracy != Accuracy::draft;
            })
            .written_at(with_method),
        // It is not written, because the plan has turned it into a step.
        integer("steps_per_contact", &R::steps_per_contact, 4, 1000000,
                note("12 or more by restitution; 45 with a dashpot or a restitution above 0.9976; by "
                     "`accuracy`"),
                "Steps in one free impact.")
            .excludes({"step"})
            .useless_for([](const R& run) { return run.step ? "'step' is given" : nullptr; })
            .never_written(),
    };
    return table;
}

const char* without_trajectory(const Output& output) {
    return output.trajectory ? nullptr : "no trajectory is kept";
}

void read_checkpoints(Document& document, const Scene&, const std::string& path, Output& into) {
    const auto text = document.text(path);
    if (!text) return;
    const bool none = *text == "none";
    into.checkpoints = none ? std::nullopt : parse_data_size(*text);
    if (!none && !into.checkpoints)
        document.fail(path,
                      fmt::format("must be a size in kB, MB, GB, KiB, MiB or GiB, or \"none\", but is {}; "
                                  "write for example \"64 MB\"",
                                  document.written_value(path)));
}

std::string checkpoints_text(const Output& from, const Scene&) {
    return quoted(from.checkpoints ? fmt::format("{} B", *from.checkpoints) : "none");
}

void read_also(Document& document, const Scene&, const std::string& path, Output& into) {
    into.also = {};
    for (const std::string& name : document.name_list(path)) {
        const std::optional<std::size_t> format = place_in(kAlsoFormats, name);
        if (!format)
            document.fail(path, fmt::format("names \"{}\", which is no format; there is {}", excerpt(name),
                                            fmt::join(kAlsoFormats, ", ")));
        into.also.add(*format);
    }
}

std::string also_text(const Output& from, const Scene&) {
    std::vector<std::string> names;
    for (std::size_t format = 0; format < kAlsoFormats.size(); ++format)
        if (from.also.has(format)) names.emplace_back(kAlsoFormats[format]);
    return names_text(names);
}

const char* without_record(const Output& output) {
    return output.trajectory ? nullptr : "no trajectory is kept, and other formats are made of it";
}

std::string about_also() {
    return fmt::format(
        "Formats of other programs that the run's frames are written in when it ends, in the folder also, "
        "as `export --to` does it: \"{}\".",
        fmt::join(kAlsoFormats, "\", \""));
}

const KeyTable<Output>& output_table() {
    using O = Output;
    static const std::string about = about_also();
    static const KeyTable<O> table{
        flag("trajectory", &O::trajectory, initial(), "Keep trajectory.nc."),
        quantity("trajectory_interval", &O::trajectory_interval, Dimension::time, positive,
                 note("one period; 1/30 s without a drive"), "Between its frames.")
            .useless_for(without_trajectory),
        quantity("measures_interval", &O::measures_interval, Dimension::time, positive,
                 note("1/8 period; 10 ms without a drive"), "Between rows of measures.csv.")
            .written_at(1),
        flag("orientation", &O::orientation, initial(), "Orientations in the trajectory.")
            .useless_for(without_trajectory),
        flag("contacts", &O::contacts, initial(), "Contacts and forces in contacts.nc.").written_at(1),
        bound(
            entry(
                "film_moments", KeyKind::flag, note("true where they take at most 100 MB"),
                "The moments of the film's pictures in film_moments.nc, for `inspect --frame` and `resume`."),
            &O::film_moments)
            .written_at(1),
        bound_by<O>(
            entry("checkpoints", KeyKind::text, literal("\"64 MB\""),
                  "Largest size of the folder checkpoints, which holds at most 20 of them over the whole "
                  "run; \"none\": no such folder."),
            read_checkpoints, checkpoints_text)
            .written_at(1),
        bound_by<O>(
            entry("instruments", KeyKind::name_list, note("those whose columns the film shows"),
                  "What is measured beside the usual columns of measures.csv: \"bed\", \"convection\", "
                  "\"energy_balance\", \"intruder\", \"outflow\", \"surface\", \"walls\"."),
            [](Document& document, const Scene&, const std::string& path, O& into) {
                into.instruments = document.name_list(path);
            },
            [](const O&, const Scene& scene) { return names_text(scene.instruments()); })
            .written_at(1),
        bound_by<O>(entry("also", KeyKind::name_list, note("none"), about.c_str()), read_also, also_text)
            .useless_for(without_record)
            .unwritten_if([](const O& output) { return !output.also.any(); })
            .written_at(1),
    };
    return table;
}

}  // namespace

void list_run(Keys& all) {
    run_table().list(all, "run");
    output_table().list(all, "output");
    list_fields(all);
}

void read_run(Document& document, Scene& scene) {
    Run& run = scene.run;
    run_table().read(document, scene, "run", run);
    if (run.contact_corrections && !correctable(scene.contact, run.integrator))
        document.fail(
            "run.contact_corrections",
            "is made for velocity-verlet and the law walton-braun with a restitution that is the same at "
            "any speed; remove it");
    output_table().read(document, scene, "output", scene.output);
}

void write_run(SceneText& out, const Scene& scene, const Reasons& reasons) {
    out.table("run");
    if (!reasons.step.empty()) out.remark("step", fmt::format("chosen for: {}", reasons.step));
    run_table().write(out, scene, scene.run);
    out.table("output");
    output_table().write(out, scene, scene.output);
    write_fields(out, scene);
}

// The keys of [output.fields]: fields by coarse-graining.

namespace {

using namespace keys;

// Every grain must count in some cell, so its kernel must reach the middle of the cell in which it lies. That
// middle is at most 0.87 of the cell's side away (half the diagonal of a cube). The Gaussian, the smaller of
// the two kernels, ends three widths away.
constexpr double largest_cell = 2;  // in widths

const char* without_fields(const FieldOutput& fields) {
    return fields.wanted() ? nullptr : "without a 'grid' no fields are kept";
}

const char* beside_phase(const FieldOutput& fields) {
    if (const char* reason = without_fields(fields)) return reason;
    return fields.phase ? "a 'phase' has one moment in each period" : nullptr;
}

// The mean diameter over the grains at the start and those that feeds give in a second. The total number of
// fed grains is not used, because it depends on the run's end: a run that is made longer later must have
// the same grid as one of that length from the beginning.
double usual_diameter(const Scene& scene) {
    std::vector<double> grains;
    for (const Species& species : scene.species) grains.push_back(static_cast<double>(species.count));
    for (const Feed& feed : scene.feeds) grains[feed.species] += feed.rate;
    double sum = 0, all = 0;
    for (std::size_t s = 0; s < grains.size(); ++s) {
        sum += grains[s] * scene.species[s].diameter.mean;
        all += grains[s];
    }
    return sum / all;
}

void usual_cell(FieldOutput& fields, const Scene&) {
    fields.cell = (fields.grid == FieldOutput::Grid::xyz ? 2 : 1) * fields.width;
}

const KeyTable<FieldOutput>& field_table() {
    using F = FieldOutput;
    static const KeyTable<F> table{
        choice(
            "grid", &F::grid, field_grid_words, initial(),
            "Fields by coarse-graining in fields.nc: means over the depth on a grid in y and z, or a grid in "
            "three dimensions."),
        choice("kernel", &F::kernel, field_kernel_words, initial(), "The function that spreads each grain.")
            .useless_for(without_fields),
        quantity("width", &F::width, Dimension::length, positive,
                 note("half of the mean diameter, feeds counted for 1 s"),
                 "Standard deviation of the kernel along one axis; for each grain at least its radius.")
            .useless_for(without_fields)
            .usually([](F& fields, const Scene& scene) { fields.width = 0.5 * usual_diameter(scene); }),
        quantity("cell", &F::cell, Dimension::length, positive, note("`width`; twice that with xyz"),
                 "Largest side of a cell; twice `width` at most.")
            .useless_for(without_fields)
            .usually(usual_cell),
        integer("periods", &F::periods, 1, 1000000, initial(),
                "One record of fields.nc is the mean over so many periods of the drive.")
            .unwritten_if([](const F& fields) { return fields.periods == 0; }),
        quantity("phase", &F::phase, Dimension::phase, any, note("all phases"),
                 "Only moments at this phase, \"90 deg\" or 0.25 turns.")
            .useless_for(without_fields),
        integer("samples", &F::samples, 1, 1000, initial(),
                "Moments in each period; without a drive in each record.")
            .useless_for(beside_phase),
        quantity("interval", &F::interval, Dimension::time, positive, note("a tenth of the run"),
                 "Without a drive: one record is the mean over this time.")
            .usually([](F& fields, const Scene& scene) { fields.interval = 0.1 * scene.run.duration; })
            .unwritten_if([](const F& fields) { return fields.interval == 0; }),
    };
    return table;
}

void check_times(Document& document, const Scene& scene, FieldOutput& fields) {
    const std::string table = "output.fields.";
    if (scene.drive.present) {
        document.refuse(table + "interval", "with a drive a record counts 'periods'");
        fields.interval = 0;
        if (fields.wanted() && scene.run.duration * scene.drive.frequency < 1 - 1e-9)
            document.fail(table + "grid",
                          "asks for means over whole periods, but the run is shorter than one; "
                          "lengthen run.duration");
        return;
    }
    for (const char* key : {"periods", "phase"})
        document.refuse(table + key, "counts by the drive, but nothing oscillates; give 'interval'");
    fields.periods = 0;
    if (ends_early(document)) fields.interval = std::min(fields.interval, scene.run.duration);
    if (clearly_more(fields.interval, scene.run.duration))
        document.fail(table + "interval", "is longer than the run; shorten it");
}

}  // namespace

void list_fields(Keys& all) {
    field_table().list(all, "output.fields");
}

void read_fields(Document& document, Scene& scene) {
    FieldOutput& fields = scene.output.fields;
    field_table().read(document, scene, "output.fields", fields);
    check_times(document, scene, fields);
    if (!fields.wanted()) return;
    if (scene.container.shape == Container::Shape::cylinder && fields.grid == FieldOutput::Grid::yz)
        document.fail("output.fields.grid",
                      "is \"yz\", but a cylinder is not as deep everywhere; write \"xyz\"");
    if (clearly_more(fields.cell, largest_cell * fields.width))
        document.fail("output.fields.cell",
                      fmt::format("is {:.3g} m, which is more than twice the kernel's width of {:.3g} m; "
                                  "give smaller cells or a larger 'width'",
                                  fields.cell, fields.width));
}

void write_fields(SceneText& out, const Scene& scene) {
    const FieldOutput& fields = scene.output.fields;
    if (!fields.wanted() && scene.instruments().empty()) return;
    out.table("output.fields");
    field_table().write(out, scene, fields);
}

}  // namespace grainreel
