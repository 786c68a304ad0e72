// Tests of what grains do to the surface of a mesh, by contacts that are made by hand.
#include <gtest/gtest.h>

#include <memory>

#include "engine/measure/walls/mesh_wear.hpp"
#include "tests/physics/measure/bed_by_hand.hpp"

namespace grainreel {
namespace {

// The square of side 2 in the plane z = 0 has two triangles and moves along x. A grain of radius 1 lies on
// it.
struct GrainOnSquare {
    test::BedByHand bed{"wear"};
    ContactView contact{};

    GrainOnSquare() {
        TriangleMesh square{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
        SceneMesh mesh;
        mesh.name = "plate";
        mesh.surface.of = std::make_shared<const Surface>(square, MeshFacts{}, "square");
        mesh.velocity = {0.5, 0, 0};
        bed.scene.container.shape = Container::Shape::none;
        bed.scene.meshes = {mesh};
        bed.add(0, {0, 0, 1}, 1);
        contact.first = 0, contact.second = -1, contact.glued = -1, contact.triangle = 1;
        contact.normal = {0, 0, -1};
        contact.normal_force = 3;
        contact.tangential = {2, 0, 0};
        contact.point = {0, 0, 0};
        bed.contacts = [this](const auto& see) { see(contact); };
        bed.start();
    }
    Motion& grain() { return bed.grains.motion[0]; }
};

// The grain comes down at 4 and slides along x at 7, 1 of it by its spin: 7 - 0.5 against the plate.
TEST(WearInstrument, HasTheWorksOfImpactAndRubbing) {
    GrainOnSquare one;
    one.grain().velocity = {6, 0, -4};
    one.grain().spin = {0, -1, 0};
    for (const std::int64_t step : {4, 10}) one.bed.gather(step);
    EXPECT_NEAR(one.bed.look(10, "plate_impact_work_J"), 3 * 4 * 0.01, 1e-12);
    EXPECT_NEAR(one.bed.look(10, "plate_shear_work_J"), 2 * 6.5 * 0.01, 1e-12);
    one.grain().velocity = {6, 0, 4};  // it leaves: there is no impact, and it still rubs
    one.bed.gather(14);
    EXPECT_NEAR(one.bed.look(14, "plate_impact_work_J"), 3 * 4 * 0.01, 1e-12);
    EXPECT_NEAR(one.bed.look(14, "plate_shear_work_J"), 2 * 6.5 * 0.014, 1e-12);
}

TEST(WearInstrument, TellsTriangles) {
    GrainOnSquare one;
    one.grain().velocity = {6.5, 0, 0};
    Observers observers(all_observers(), one.bed.scene, one.bed.plan);
    const auto contacts = one.bed.contacts;
    observers.start(one.bed.moment(0), contacts);
    observers.gather(one.bed.moment(6), contacts);
    const std::vector<MeshWear> wear =
        wear_among(one.bed.scene, observers.fields(), observers.look_at_fields(one.bed.moment(6), contacts));
    ASSERT_EQ(wear.size(), 1u);
    EXPECT_EQ(wear[0].pressure[0], 0);
    EXPECT_NEAR(wear[0].pressure[1], 3 / 2.0, 1e-12);  // 3 N on half of the square
    EXPECT_EQ(wear[0].wear[0], 0);
    EXPECT_NEAR(wear[0].wear[1], 2 * 6 * 0.006 / 2, 1e-12);
}

}  // namespace
}  // namespace grainreel
