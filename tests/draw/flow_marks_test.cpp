// Tests of the velocity field of arrows and streamlines, and of the lines themselves.
#include "render/picture/base/shot.hpp"
#include "render/picture/marks/field_marks.hpp"

#include <gtest/gtest.h>

#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

// Grains spread evenly over the upper part of the wedge, of two sizes and species.
Shot spread_grains() {
    std::vector<Ball> balls;
    for (int k = 0; k < 4000; ++k) {
        const double y = -0.07 + 0.14 * std::fmod(k * 0.618034, 1), z = 0.15 * std::fmod(k * 0.754878, 1);
        balls.push_back({{0.018 * std::sin(k), y, z}, 0.001 + 0.001 * (k % 3), k % 2});
    }
    return frame_of(balls);
}

const Vec3 turning(7, 0, 0), axis(0, 0.01, 0.08);  // rad/s, m

Shot rotating_grains() {
    Shot frame = spread_grains();
    for (std::size_t i = 0; i < frame.size(); ++i)
        frame.velocity[i] = turning.cross(frame.position[i] - axis);
    return frame;
}

// sum m v W / sum m W with W = exp(-r^2 / 2 w^2) within 3 w (Goldhirsch 2010, Granul. Matter 12, 239, eq. 4).
Vec3 coarse_grained(const Shot& frame, double width, double y, double z) {
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const double square = std::pow(frame.position[i].y() - y, 2) + std::pow(frame.position[i].z() - z, 2);
        if (square > 9 * width * width) continue;
        const double m = std::pow(frame.radius[i], 3) * std::exp(-square / (2 * width * width));
        momentum += m * frame.velocity[i];
        mass += m;
    }
    return momentum / mass;
}

TEST(VelocityField, IsMomentumOverMassUnderTheKernel) {
    const FilmedScene scene = wedge();
    const Shot frame = rotating_grains();
    constexpr double width = 0.006;
    VelocityField field(scene, width, false);
    field.take(frame);
    int there = 0;
    for (double y = -0.05; y < 0.055; y += 0.01)
        for (double z = 0.1; z < 0.135; z += 0.01) {
            const std::optional<Vec3> here = field.at(y, z);
            ASSERT_TRUE(here) << y << " " << z;
            // Between the middles of cells the field is linear; a cell is half a width.
            EXPECT_LT((*here - coarse_grained(frame, width, y, z)).norm(), 0.02 * turning.norm() * width);
            ++there;
        }
    EXPECT_GE(there, 30);
    EXPECT_FALSE(field.at(0.0745, 0.02)) << "in the slant";
    EXPECT_FALSE(field.at(0, 0.5));
}

// A quarter of a turn moves the origin of a container whose axis lies elsewhere. The axis stays, and so does
// the grid.
TEST(VelocityField, StandsWhereTheAxisOfATurningContainerIs) {
    FilmedScene scene = wedge();
    Shot frame = rotating_grains();
    VelocityField still(scene, 0.006, false);
    still.take(frame);
    FilmedScene drum = wedge();
    drum.container.turn.emplace();
    drum.container.turn->axis = Vec3(1, 0, 0);
    drum.container.turn->through = axis;
    frame.container().rotation = Eigen::AngleAxisd(0.5 * pi, Vec3(1, 0, 0));
    frame.container().place = axis - frame.container().rotation * axis;
    VelocityField turned(drum, 0.006, false);
    turned.take(frame);
    for (double y = -0.05; y < 0.055; y += 0.01) {
        ASSERT_TRUE(turned.at(y, 0.11)) << y;
        // The cells lie elsewhere, because the container needs more room.
        EXPECT_LT((*turned.at(y, 0.11) - *still.at(y, 0.11)).norm(), 0.02 * turning.norm() * 0.006) << y;
    }
}

TEST(VelocityField, OfAPeriodIsDisplacementTimesFrequency) {
    const FilmedScene scene = wedge();
    Shot frame = spread_grains();
    VelocityField field(scene, 0.006, true);
    field.take(frame);
    EXPECT_FALSE(field.at(0, 0.12)) << "no displacements yet";
    frame.displacement.assign(frame.size(), Vec3(0, 0.001, -0.002));
    for (std::size_t i = 0; i < frame.size(); i += 7)
        frame.displacement[i] = Vec3::Constant(std::nan(""));  // it was not there a period before
    field.take(frame);
    const std::optional<Vec3> here = field.at(0.01, 0.12);
    ASSERT_TRUE(here);
    EXPECT_LT((*here - scene.drive.frequency * Vec3(0, 0.001, -0.002)).norm(), 1e-12);
}

// The frequency goes from 20 Hz to 45 Hz over the first three periods from 0.1 s on.
TEST(VelocityField, OfAPeriodGoesByTheFrequencyThatIsOn) {
    FilmedScene scene = wedge();
    scene.drive.stages = {{DriveStage::Kind::vibrate, 0.1, 3, 45, 0.001}};
    Shot frame = spread_grains();
    frame.displacement.assign(frame.size(), Vec3(0, 0.001, -0.002));
    VelocityField field(scene, 0.006, true);
    for (const auto& [cycles, frequency] : {std::pair{1.5, 20}, {9.0, 45}}) {
        frame.cycles = cycles;
        field.take(frame);
        const std::optional<Vec3> here = field.at(0.01, 0.12);
        ASSERT_TRUE(here);
        EXPECT_LT((*here - frequency * Vec3(0, 0.001, -0.002)).norm(), 1e-9) << cycles;
    }
}

TEST(VelocityField, NeedsThreeGrainsAndGoesWithTheContainer) {
    const FilmedScene scene = wedge();
    const Vec3 moved(0, 0.003, 0.004);
    const auto field_of = [&](int grains) {
        Shot frame =
            frame_of(std::vector<Ball>(static_cast<std::size_t>(grains), {Vec3(0, 0, 0.12) + moved, 0.0025}));
        frame.velocity.assign(frame.size(), Vec3(0, 0, 1));
        frame.container().place = moved;
        VelocityField field(scene, 0.01, false);
        field.take(frame);
        return field.at(0, 0.12);
    };
    // The Gaussian gives a grain the weight 2 / (4 pi w^2) in the middle; this species has the grains' size.
    EXPECT_FALSE(field_of(1));
    ASSERT_TRUE(field_of(2));
    EXPECT_NEAR(field_of(2)->z(), 1, 1e-12);
}

TEST(Streamlines, OfARotationAreCirclesThatRunItsWay) {
    const PlaneVelocity rotation = [](const Eigen::Vector2d& at) -> std::optional<Eigen::Vector2d> {
        return Eigen::Vector2d(-7 * at.y(), 7 * at.x());
    };
    const std::vector<StreamPoint> line = streamline(rotation, {0.03, 0}, 0.06, 0.003);
    ASSERT_EQ(line.size(), 41u);
    double turned = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        EXPECT_NEAR(line[k].at.norm(), 0.03, 1e-7);
        EXPECT_NEAR(line[k].speed, 7 * 0.03, 1e-6);
        if (k > 0)
            turned += std::atan2(line[k - 1].at.x() * line[k].at.y() - line[k - 1].at.y() * line[k].at.x(),
                                 line[k - 1].at.dot(line[k].at));
    }
    EXPECT_NEAR(turned, 2 * 0.06 / 0.03, 1e-4);  // length over radius, counter-clockwise
}

TEST(Streamlines, EndWhereTheFlowDoes) {
    const PlaneVelocity half = [](const Eigen::Vector2d& at) -> std::optional<Eigen::Vector2d> {
        if (at.x() > 0.01) return std::nullopt;
        return Eigen::Vector2d(1, 0);
    };
    const std::vector<StreamPoint> line = streamline(half, {0, 0}, 0.05, 0.001);
    ASSERT_FALSE(line.empty());
    EXPECT_NEAR(line.front().at.x(), -0.05, 1e-9);
    EXPECT_NEAR(line.back().at.x(), 0.01, 0.0011);
    EXPECT_TRUE(streamline(half, {0.02, 0}, 0.05, 0.001).empty());
}

Extent extent_of_marks(const FilmedScene& scene, const Shot& frame) {
    Shapes shapes;
    FlowMarks(scene, make_palette({1, 1, 1})).draw(view_of(scene), frame, shapes);
    return extent_of_vertices(shapes);
}

// A scene seen from the front without perspective, with arrows or streamlines on cells as wide as a third of
// the box.
FilmedScene flat_scene() {
    FilmedScene scene = wedge();
    set_species(scene, {{"small", 3, 2e-4, blue}});
    scene.film.camera.field_of_view = 0;
    scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    return scene;
}

Shot moving(const std::vector<Ball>& balls, const Vec3& velocity) {
    Shot frame = frame_of(balls);
    frame.velocity.assign(frame.size(), velocity);
    return frame;
}

// An arrow lies about the middle of its cell, at the height 0.075. It is widest just behind its point, so
// there is more of it on the side of its tip. It is never longer than one and a half cells.
TEST(Arrows, GoWithTheFlowAndAreNotTooLong) {
    FilmedScene scene = flat_scene();
    scene.film.shows.arrows = {3, 0.1, false};
    const View view = view_of(scene);
    const Pixel middle = view.project(Vec3(0, 0, 0.075));
    const double cell = 0.05 * view.focal;
    for (const double speed : {0.05, -0.05, 0.1, 1.0}) {
        const Shot frame = moving(std::vector<Ball>(3, {Vec3(0, 0, 0.075), 1e-4, 0}), Vec3(0, speed, 0));
        Shapes shapes;
        FlowMarks(scene, make_palette({1, 1, 1})).draw(view, frame, shapes);
        double widest = 0, at = 0;
        for (const Shapes::Vertex& vertex : shapes.vertices())
            if (std::abs(vertex.y - middle.y()) > widest)
                widest = std::abs(vertex.y - middle.y()), at = vertex.x;
        EXPECT_GT((at - middle.x()) * speed, 0) << speed;
        const Extent seen = extent_of_marks(scene, frame);
        EXPECT_NEAR(seen.right - seen.left, std::min(std::abs(speed) / 0.1, 1.5) * cell, 8) << speed;
        EXPECT_NEAR(0.5 * (seen.left + seen.right), middle.x(), 4) << speed;
    }
}

TEST(Streamlines, LieAlongTheFlow) {
    FilmedScene scene = flat_scene();
    scene.film.shows.streamlines = {1, 0.1, false};
    std::vector<Ball> row;
    for (int k = 0; k < 400; ++k) row.push_back({Vec3(0, -0.06 + 0.0003 * k, 0.075), 1e-4, 0});
    const Extent seen = extent_of_marks(scene, moving(row, Vec3(0, 0.1, 0)));
    ASSERT_GT(seen.count, 0);
    EXPECT_GT(seen.right - seen.left, 5 * (seen.bottom - seen.top));
}

// Lines and arrows are drawn where the flow is, and nowhere else.
TEST(Streamlines, AreInThePictureAndFadeWithTheFlow) {
    FilmedScene scene = wedge();
    scene.film.words = WordPlace::none;
    Shot frame = rotating_grains();
    const Picture plain = Renderer(scene, 1).draw(frame, "");
    scene.film.shows.streamlines = {8, 0.2, false};
    const Rectangle all{0, 0, plain.width, plain.height};
    const int fast = changed(Renderer(scene, 1).draw(frame, ""), plain, all, 60).count;
    EXPECT_GT(fast, 1000);
    for (Vec3& velocity : frame.velocity) velocity *= 1e-4;
    EXPECT_EQ(changed(Renderer(scene, 1).draw(frame, ""), plain, all, 60).count, 0);
}

}  // namespace
}  // namespace grainreel::test
