// Tests of the state from which fields are computed, and of how a record of a run is made of it.
#include <gtest/gtest.h>

#include "engine/measure/fields/coarse_graining_observer.hpp"
#include "tests/physics/fields/field_scene.hpp"

namespace grainreel {
namespace {

using Moves = Drive::Moves;

// Two grains of 3 kg/m3 in a box that has moved.
struct MovedBox {
    Scene scene = field_box({4, 4, 4}, FieldOutput::Grid::yz, 0.5, 0.25);
    Plan plan;
    Grains grains;
    Traffic traffic;
    DrivePose pose{{0, 0.3, 0.2}, {0, 5, 7}, 0};

    explicit MovedBox(Moves moves) {
        scene.drive.present = true;
        scene.drive.moves = moves;
        scene.species[0].density = 3;
        grains.add(0, 0, {-2.1, 0.5, 0.6}, 0.4, 3);  // its image inside the box is at 1.9
        grains.add(1, 0, {1.9, 0.5, 1.4}, 0.5, 3);
        grains.motion[0].velocity = {1, 2, 3};
    }
    ObservedState moment() const { return {scene, plan.clock, grains, 0, {0, 0, -10}, 4, pose, 0, traffic}; }
};

TEST(FieldState, PlacesAndVelocitiesAreAgainstTheContainer) {
    const MovedBox moved(Moves::container);
    const FieldGrain grain = field_grain(moved.moment(), 0);
    EXPECT_LT((grain.position - Vec3(1.9, 0.2, 0.4)).norm(), 1e-12);
    EXPECT_LT((grain.velocity - Vec3(1, -3, -4)).norm(), 1e-12);
    EXPECT_NEAR(grain.volume, 4.0 / 3 * std::numbers::pi * 0.064, 1e-12);
    EXPECT_NEAR(grain.mass, 3 * grain.volume, 1e-12);
}

TEST(FieldState, WhereTheFloorAloneMovesTheyAreAgainstTheRoom) {
    const MovedBox moved(Moves::floor);
    const FieldGrain grain = field_grain(moved.moment(), 0);
    EXPECT_LT((grain.position - Vec3(1.9, 0.5, 0.6)).norm(), 1e-12);
    EXPECT_LT((grain.velocity - Vec3(1, 2, 3)).norm(), 1e-12);
}

ContactView touch(std::int32_t second, const Vec3& normal, double overlap) {
    ContactView contact{};
    contact.second = second;
    contact.glued = -1;
    contact.normal = normal;
    contact.overlap = overlap;
    contact.normal_force = 6;
    contact.tangential = {0.5, 0, 0};
    return contact;
}

// The branch ends at the other grain's centre or on the face of a wall. The force includes friction.
TEST(FieldState, BranchesEndAtACentreOrOnAFace) {
    const MovedBox moved(Moves::floor);
    const FieldBranch pair = field_contact(moved.moment(), touch(1, {0, 0, 1}, 0.1));
    EXPECT_LT((pair.begin - Vec3(1.9, 0.5, 0.6)).norm(), 1e-12);
    EXPECT_LT((pair.branch - Vec3(0, 0, 0.4 + 0.5 - 0.1)).norm(), 1e-12);
    EXPECT_LT((pair.force - Vec3(0.5, 0, 6)).norm(), 1e-12);
    const FieldBranch wall = field_contact(moved.moment(), touch(-1, {0, 0, -1}, 0.05));
    EXPECT_LT((wall.branch - Vec3(0, 0, -0.35)).norm(), 1e-12);
    EXPECT_LT((wall.force - Vec3(0.5, 0, -6)).norm(), 1e-12);
    // Each end has the kernel of its own grain; at a wall both ends have that of the grain.
    EXPECT_EQ(pair.radius, 0.4);
    EXPECT_EQ(pair.other_radius, 0.5);
    EXPECT_EQ(wall.radius, 0.4);
    EXPECT_EQ(wall.other_radius, 0.4);
}

// Two moments in each of two periods of 40 steps.
FieldTimes two_phases() {
    FieldOutput fields;
    fields.periods = 2;
    fields.samples = 2;
    return field_times(fields, Clock{1, 40, 0}, 160);
}

// All grains go up at one phase and down at the other, which is no heat. In the second record they also
// drift.
TEST(FieldRecords, KeepPhasesAndRecordsApart) {
    const Scene scene = field_box({5, 5, 5}, FieldOutput::Grid::yz, 0.5, 0.5);
    const FieldTimes times = two_phases();
    FieldMeans record(scene, times);
    const GridAxis &y = record.sums().grid().axes[1], &z = record.sums().grid().axes[2];
    const auto middle = static_cast<std::size_t>(record.sums().grid().index(0, y.count / 2, z.count / 2));
    for (std::int64_t step = 0; step != FieldTimes::kNever; step = times.next(step)) {
        FieldState state = cubic_packing();
        for (FieldGrain& grain : state.grains)
            grain.velocity = Vec3(0, 0, (step % 40 == 0 ? 1 : -1) + (step < 80 ? 0 : 3));
        step == 0 ? record.start(step, state) : record.gather(step, state);
        if (step != 80 && step != 160) continue;
        ASSERT_TRUE(record.last());
        EXPECT_NEAR(record.last()->velocity[2][middle], step == 80 ? 0 : 3, 1e-12) << step;
        EXPECT_NEAR(record.last()->temperature[middle], 0, 1e-12) << step;
        EXPECT_NEAR(integral(record.sums(), record.last()->density), 125, 1e-8) << step;
    }
}

// The sum of stress over all cells is the sum of force times branch, including contacts with walls.
TEST(FieldRecords, HaveTheContactsWithWalls) {
    MovedBox box(Moves::floor);
    box.plan.fields = two_phases();
    observers::CoarseGrainedFields observer(box.scene, box.plan);
    for (const std::int64_t step : {0, 20, 40, 60, 80}) {
        ObservedState moment = box.moment();
        moment.step = step;
        observer.begin(moment);
        observer.contact(moment, touch(1, {0, 0, 1}, 0.1));
        observer.contact(moment, touch(-1, {0, 0, -1}, 0.05));
        step == 0 ? observer.start(moment) : observer.gather(moment);
    }
    const FieldSet& set = *observer.fields();
    const FieldValues values = observer.look_at_fields(box.moment());
    for (std::size_t f = 0; f < set.fields.size(); ++f) {
        if (set.fields[f].name != "contact_stress_zz") continue;
        double sum = 0;
        for (const double stress : values[f]) sum += stress;
        const FieldGrid grid = make_field_grid(box.scene, box.scene.output.fields);
        EXPECT_NEAR(sum * grid.cell_volume(), 6 * 0.8 + 6 * 0.35, 1e-10);
        return;
    }
    ADD_FAILURE() << "no such field";
}

}  // namespace
}  // namespace grainreel
