// The keys of [output.fields]: fields by coarse-graining.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/chapters/words.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;

// A cell must not miss a grain: the least kernel ends three widths away, and the middle of a cell is at most
// 0.87 of its side away.
constexpr double largest_cell = 2;  // widths

const char* without_fields(const FieldOutput& fields) {
    return fields.wanted() ? nullptr : "without a 'grid' no fields are kept";
}

const char* beside_phase(const FieldOutput& fields) {
    if (const char* reason = without_fields(fields)) return reason;
    return fields.phase ? "a 'phase' has one moment in each period" : nullptr;
}

// Mean over the grains at the start and those that the feeds give in a second. How many come in all depends
// on the run's end, and a run that is made longer has the same grid as one that was so long from the
// beginning.
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
        choice("kernel", &F::kernel, field_kernel_words, initial(), "What a grain is spread with.")
            .useless_for(without_fields),
        quantity("width", &F::width, Dimension::length, positive,
                 note("half of the mean diameter, feeds counted for 1 s"),
                 "Standard deviation of the kernel along one axis; of a grain's own, its radius at least.")
            .useless_for(without_fields)
            .usually([](F& fields, const Scene& scene) { fields.width = 0.5 * usual_diameter(scene); }),
        quantity("cell", &F::cell, Dimension::length, positive, note("`width`; twice that with xyz"),
                 "Largest side of a cell; twice `width` at most.")
            .useless_for(without_fields)
            .usually(usual_cell),
        integer("periods", &F::periods, 1, 1000000, initial(),
                "Periods of the drive that one record of fields.nc is the mean of.")
            .unwritten_if([](const F& fields) { return fields.periods == 0; }),
        quantity("phase", &F::phase, Dimension::phase, any, note("all phases"),
                 "Only moments at this phase, \"90 deg\" or 0.25 turns.")
            .useless_for(without_fields),
        integer("samples", &F::samples, 1, 1000, initial(),
                "Moments in each period; without a drive in each record.")
            .useless_for(beside_phase),
        quantity("interval", &F::interval, Dimension::time, positive, note("a tenth of the run"),
                 "Without a drive: time that one record is the mean of.")
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
