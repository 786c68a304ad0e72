// Tests of fields of whole runs: they give the weight of a bed at rest, and are the same on any number of
// threads and through a checkpoint.
#include "engine/measure/fields/coarse_graining_observer.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

// There is neither friction nor front and back, so the floor alone carries the bed.
const std::string column_text =
    test::SmallScene("gravity = 9.81\n")
        .beads(150, "glass", "3.6 mm to 4.4 mm")
        .more("[contact]\nlaw = \"spring-dashpot\"\nrestitution = 0.3\nfriction = 0\n")
        .box("20 mm", "26 mm", "60 mm")
        .more("periodic_depth = true\n")
        .lasts("0.2 s")
        .more("overlap = 0.05\nthreads = 1\n")
        .text();

std::vector<double> field_of(const SimulatedBed& run, const std::string& name) {
    const FieldSet& set = *run.field_sets().at(0);
    for (std::size_t f = 0; f < set.fields.size(); ++f)
        if (set.fields[f].name == name) return run.fields().at(0).at(f);
    ADD_FAILURE() << "no field " << name;
    return {};
}

TEST(FieldsOfRun, BedAtRestCarriesTheWeightAbove) {
    for (const char* grid : {"yz", "xyz"}) {
        const Scene scene = read_scene_text(
            column_text, "column.toml",
            with_tested_precision({std::string("output.fields.grid=") + grid, "output.fields.cell=2 mm",
                                   "output.fields.interval=0.1 s", "output.fields.samples=5"}));
        const Plan plan = make_plan(scene);
        SimulatedBed run(scene, plan, 1);
        run.pack();
        run.advance(plan.steps);
        const FieldGrid cells = make_field_grid(scene, scene.output.fields);
        const GridAxis& z = cells.axes[2];
        const auto layer = static_cast<std::size_t>(cells.axes[0].count * cells.axes[1].count);
        const std::vector<double> density = field_of(run, "density"), volume = field_of(run, "free_volume"),
                                  contact = field_of(run, "contact_stress_zz"),
                                  kinetic = field_of(run, "kinetic_stress_zz");
        double weight = 0;  // N
        for (std::size_t c = 0; c < density.size(); ++c) weight += density[c] * volume[c] * 9.81;
        double above = 0;
        const double reach = FieldKernel(scene.output.fields.kernel, scene.output.fields.width, 3).cutoff();
        for (std::int64_t k = z.count - 1; z.middle(k) > reach; --k) {
            double here = 0, carried = 0;
            for (std::size_t c = static_cast<std::size_t>(k) * layer;
                 c < (static_cast<std::size_t>(k) + 1) * layer; ++c) {
                here += density[c] * volume[c] * 9.81;
                carried += (contact[c] + kinetic[c]) * cells.cell_volume() / z.cell;
            }
            EXPECT_NEAR(carried, above + here / 2, 0.01 * weight) << grid << " at " << z.middle(k);
            above += here;
        }
        EXPECT_GT(above, 0.6 * weight);
    }
}

class ShakenFields : public testing::Test {
  protected:
    static Scene with_fields(std::vector<std::string> sets) {
        sets.insert(sets.begin(),
                    {"contact.stiffness=700 N/m", "output.fields.grid=yz", "output.fields.periods=2"});
        return read_scene_text(test::small_scene_text, "fifty.toml", with_tested_precision(sets));
    }
    static Scene scene_of(std::vector<std::string> sets = {}) {
        sets.insert(sets.begin(), "start.settle_limit=0.02 s");
        return with_fields(sets);
    }
    Scene next_of(std::vector<std::string> sets = {}) const {
        sets.insert(sets.begin(), {"start.method=file", "start.file=" + (here / "half.grs").string(),
                                   "start.keep_clock=true"});
        return with_fields(sets);
    }
    static FieldValues fields_at(SimulatedBed& run, std::int64_t step) {
        run.advance(step);
        return run.fields().at(0);
    }
    static bool same(const FieldValues& a, const FieldValues& b) {
        for (std::size_t f = 0; f < a.size(); ++f)
            if (a[f].size() != b[f].size() ||
                std::memcmp(a[f].data(), b[f].data(), a[f].size() * sizeof(double)) != 0)
                return false;
        return a.size() == b.size();
    }
    test::TemporaryFolder here;
};

TEST_F(ShakenFields, AreTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    std::vector<FieldValues> found;
    for (const int threads : {1, 2, 3}) {
        SimulatedBed run(scene, plan, threads);
        run.pack();
        found.push_back(fields_at(run, plan.fields.record));
        EXPECT_FALSE(same(found.back(), fields_at(run, plan.fields.end))) << "a second record";
    }
    EXPECT_TRUE(same(found[0], found[1]));
    EXPECT_TRUE(same(found[0], found[2]));
}

TEST_F(ShakenFields, GoOnThroughACheckpoint) {
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    run.advance(plan.fields.record * 2 / 3);
    run.save_checkpoint(here / "half.grs");
    const FieldValues unbroken = fields_at(run, plan.fields.record);

    SimulatedBed next(next_of(), plan, 1);
    next.pack();
    EXPECT_TRUE(same(unbroken, fields_at(next, plan.fields.record)));

    // With another kernel, gathered sums are of no use, and the first whole record is the next one.
    const Scene other = next_of({"output.fields.width=3 mm"});
    SimulatedBed changed(other, make_plan(other), 1);
    changed.pack();
    EXPECT_TRUE(std::isnan(fields_at(changed, plan.fields.record)[1][0]));
    EXPECT_FALSE(std::isnan(fields_at(changed, plan.fields.end)[1][0]));
}

// A checkpoint of the step at which a record ends may be saved before the record is written.
TEST_F(ShakenFields, AFinishedRecordIsInTheCheckpointOfItsEnd) {
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    const FieldValues written = fields_at(run, plan.fields.record);
    run.save_checkpoint(here / "half.grs");
    SimulatedBed next(next_of(), plan, 1);
    next.pack();
    EXPECT_TRUE(same(written, next.fields()[0]));
    EXPECT_TRUE(same(fields_at(run, plan.fields.end), fields_at(next, plan.fields.end)));
}

TEST(FieldTimes, RecordsAreWholePeriodsAndTheLastMayBeShorter) {
    FieldOutput fields;
    fields.periods = 2;
    fields.samples = 16;
    const Clock clock{1, 40, 0};
    const FieldTimes times = field_times(fields, clock, 215);  // 5.4 periods
    std::vector<std::int64_t> ends;
    for (std::int64_t step = times.next_end(0); step != FieldTimes::kNever; step = times.next_end(step + 1))
        ends.push_back(step);
    EXPECT_EQ(ends, (std::vector<std::int64_t>{80, 160, 200}));
    EXPECT_EQ(times.begin_of_record(160), 80);
    EXPECT_EQ(times.begin_of_record(200), 160);
    std::vector<std::int64_t> seen(16, 0);  // number of moments of each phase
    for (std::int64_t step = 0; step != FieldTimes::kNever; step = times.next(step)) {
        if (!times.is_moment(step)) continue;
        ++seen[static_cast<std::size_t>(times.phase_of(step))];
        EXPECT_EQ(times.phase_of(step), times.phase_of(step % 40)) << step;
    }
    EXPECT_EQ(seen, std::vector<std::int64_t>(16, 5));
}

TEST(FieldTimes, OnePhaseIsMetOnceAPeriod) {
    FieldOutput fields;
    fields.periods = 3;
    fields.phase = 0.25;
    const FieldTimes times = field_times(fields, Clock{1, 40, 0.5}, 130);
    std::vector<std::int64_t> moments;
    for (std::int64_t step = 0; step != FieldTimes::kNever; step = times.next(step))
        if (times.is_moment(step)) moments.push_back(step);
    EXPECT_EQ(moments, (std::vector<std::int64_t>{30, 70, 110}));  // the phase is 0.5 at step 0
    EXPECT_EQ(times.phases, 1);
}

}  // namespace
}  // namespace grainreel
