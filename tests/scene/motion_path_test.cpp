// Tests of motions from files and of turns: positions and velocities against closed forms.
#include "engine/scene/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/scene/meshes_by_hand.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;
using test::tells;
using testing::HasSubstr;

constexpr double amplitude = 0.01, period = 0.5, swing = 0.3;  // m, s, rad

// A file of two periods of x = a sin, z = 2 a sin, whose second derivative is zero at both ends, and of a
// swing about y.
std::string sines(int rows, bool turns) {
    std::string text = turns ? "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n" : "time_s,x_m,y_m,z_m\n";
    for (int i = 0; i <= rows; ++i) {
        const double t = 2 * period * i / rows, s = std::sin(2 * pi * t / period);
        text += fmt::format("{:.17g},{:.17g},0,{:.17g}", t, amplitude * s, 2 * amplitude * s);
        if (turns)
            text += fmt::format(",{:.17g},0,{:.17g},0", std::cos(0.5 * swing * s), std::sin(0.5 * swing * s));
        text += "\n";
    }
    return text;
}

double worst_place(const MotionPath& path) {
    double worst = 0;
    for (int k = 0; k <= 2000; ++k) {
        const double t = 2 * period * k / 2000, s = std::sin(2 * pi * t / period);
        worst = std::max(worst, (path.at(t).place - amplitude * s * Vec3(1, 0, 2)).norm());
    }
    return worst;
}

// The error of a cubic spline falls with the fourth power of the distance between its points.
TEST(MotionPath, FollowsASineToTheFourthPowerOfItsSteps) {
    const MeshScenes files;
    const double coarse = worst_place(*MotionPath::read(files.write("coarse.csv", sines(40, false))));
    const double fine = worst_place(*MotionPath::read(files.write("fine.csv", sines(80, false))));
    // 5/384 h^4 |f''''| is the bound of de Boor, ch. V.
    const double h = 2 * period / 80,
                 bound = 5.0 / 384 * std::pow(2 * pi * h / period, 4) * std::sqrt(5.0) * amplitude;
    EXPECT_LT(fine, bound);
    EXPECT_GT(fine, 0.05 * bound);
    EXPECT_NEAR(coarse / fine, 16, 1.5);
}

TEST(MotionPath, VelocityAndSpinAreTheDerivatives) {
    const MeshScenes files;
    const Vec3 pivot(0.02, -0.01, 0.05);
    const auto path = MotionPath::read(files.write("path.csv", sines(64, true)), pivot);
    ASSERT_TRUE(path->turns());
    constexpr double dt = 1e-6;
    for (int k = 1; k < 100; ++k) {
        const double t = 2 * period * k / 100;
        const PathPose before = path->at(t - dt), now = path->at(t), after = path->at(t + dt);
        EXPECT_LT((now.velocity - (after.place - before.place) / (2 * dt)).norm(), 1e-8);
        const Eigen::AngleAxisd turned(after.rotation * before.rotation.conjugate());
        EXPECT_LT((now.spin - turned.angle() / (2 * dt) * turned.axis()).norm(), 1e-7);
        EXPECT_NEAR(now.rotation.norm(), 1, 1e-15);
        // The pivot itself moves along the path.
        const double s = std::sin(2 * pi * t / period);
        EXPECT_LT((now.place + now.rotation * pivot - pivot - amplitude * s * Vec3(1, 0, 2)).norm(), 1e-6);
    }
    EXPECT_NEAR(path->top_speed(), std::sqrt(5.0) * amplitude * 2 * pi / period, 1e-4 * path->top_speed());
    EXPECT_NEAR(path->top_spin(), swing * 2 * pi / period, 1e-3 * path->top_spin());
}

TEST(MotionPath, StandsBeforeAndAfter) {
    const MeshScenes files;
    const auto path =
        MotionPath::read(files.write("path.csv", "t,x,y,z\n-1,-1,0,0\n0,0,0,0\n1,1,0,0\n2,2,0,0\n"));
    EXPECT_EQ(path->at(-3).place, Vec3(-1, 0, 0));
    EXPECT_EQ(path->at(-3).velocity, Vec3(0, 0, 0));
    EXPECT_LT((path->at(0.25).place - Vec3(0.25, 0, 0)).norm(), 1e-15);
    EXPECT_LT((path->at(2).velocity - Vec3(1, 0, 0)).norm(), 1e-15);
    EXPECT_EQ(path->at(5).place, path->at(2).place);
    EXPECT_EQ(path->at(5).velocity, Vec3(0, 0, 0));
}

// q and -q are the same rotation: a file may change from one to the other.
TEST(MotionPath, TakesQuaternionsOfEitherSign) {
    const MeshScenes files;
    const auto text = [](double sign) {
        std::string rows = "t,x,y,z,qw,qx,qy,qz\n";
        for (int i = 0; i <= 20; ++i)
            rows += fmt::format("{},0,0,0,{},0,0,{}\n", 0.1 * i, (i % 2 ? sign : 1) * std::cos(0.1 * i),
                                (i % 2 ? sign : 1) * std::sin(0.1 * i));
        return rows;
    };
    const auto plain = MotionPath::read(files.write("plain.csv", text(1)));
    const auto flipped = MotionPath::read(files.write("flipped.csv", text(-1)));
    for (int k = 0; k <= 40; ++k) {
        EXPECT_EQ(plain->at(0.05 * k).spin, flipped->at(0.05 * k).spin);
        EXPECT_EQ(plain->at(0.05 * k).rotation.coeffs(), flipped->at(0.05 * k).rotation.coeffs());
    }
    EXPECT_LT((plain->at(1).spin - Vec3(0, 0, 2)).norm(), 1e-3);
}

std::string complaint(const MeshScenes& files, const std::string& text) {
    try {
        MotionPath::read(files.write("path.csv", text));
    } catch (const UserError& error) {
        return std::string(error.what()).substr(files.path().string().size() + 1);
    }
    return "none";
}

TEST(MotionPath, SaysWhatIsWrongAndWhere) {
    const MeshScenes files;
    const std::string head = "t,x,y,z\n", rows = "0,0,0,0\n1,0,0,0\n2,0,0,0\n3,0,0,0\n";
    EXPECT_EQ(complaint(files, head + rows), "none");
    EXPECT_EQ(
        complaint(
            files,
            "\xef\xbb\xbf# measured\r\n\r\nt , x, y, z\r\n0, +0, 0, 0\r\n1,0,0,0\n2,0,0,0\n3,0,0,1e-3\n"),
        "none");
    EXPECT_THAT(complaint(files, ""), HasSubstr("path.csv:1: is empty; "));
    EXPECT_THAT(complaint(files, "t,x,y\n0,0,0\n"), HasSubstr("path.csv:1: lacks the column \"z_m\""));
    EXPECT_THAT(complaint(files, "t,x,y,z,vx\n"), tells({"path.csv:1", "\"vx\"", "means nothing"}));
    EXPECT_THAT(complaint(files, "t,x,y,z,x\n"), tells({"path.csv:1", "two columns", "\"x\""}));
    EXPECT_THAT(complaint(files, "t,x,y,z,qw\n"), HasSubstr("path.csv:1: lacks the column \"qx\""));
    EXPECT_THAT(complaint(files, rows), tells({"path.csv:1", "\"0\"", "means nothing"}));
    EXPECT_THAT(complaint(files, head + rows + "4,0\n"), tells({"path.csv:6", "2 values", "names 4"}));
    EXPECT_THAT(complaint(files, head + rows + "2.5,0,0,0\n"),
                tells({"path.csv:6", "2.5 s", "not later", "3 s", "line 5"}));
    EXPECT_THAT(complaint(files, head + rows + "4,nan,0,0\n"), tells({"path.csv:6", "\"nan\"", "x_m"}));
    EXPECT_THAT(complaint(files, head + rows + "4,1.5d0,0,0\n"), tells({"\"1.5d0\"", "x_m", "no"}));
    EXPECT_THAT(complaint(files, head + "0,0,0,0\n1,0,0,0\n2,0,0,0\n"),
                tells({"3 rows", "4 are the fewest"}));
    EXPECT_THAT(complaint(files, head + "1,0,0,0\n2,0,0,0\n3,0,0,0\n4,0,0,0\n"),
                tells({"path.csv:2", "1 s", "run begins", "0 s"}));
    EXPECT_THAT(complaint(files, "t,x,y,z,qw,qx,qy,qz\n0,0,0,0,2,0,0,0\n"),
                tells({"path.csv:2", "qw, qx, qy, qz"}));
    EXPECT_THAT(
        complaint(
            files,
            "t,x,y,z,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0,0,0,1,0,0\n2,0,0,0,0,1,0,0\n3,0,0,0,0,1,0,0\n"),
        tells({"path.csv:3", "turns by 3.142 rad", "line 2"}));
}

// The mesh rests until the run begins.
TEST(MotionPath, BeginsWhereTheMeshRests) {
    const MeshScenes files;
    EXPECT_THAT(complaint(files, "t,x,y,z\n0,1,0,0\n1,1,0,0\n2,1,0,0\n3,2,0,0\n"),
                tells({"path.csv", "0 s", "(1, 0, 0) m", "mesh rests"}));
    EXPECT_THAT(complaint(files,
                          "t,x,y,z,qw,qx,qy,qz\n0,0,0,0,0.6,0.8,0,0\n1,0,0,0,0.6,0.8,0,0\n"
                          "2,0,0,0,0.6,0.8,0,0\n3,0,0,0,0.6,0.8,0,0\n"),
                HasSubstr("m, turned, but places count"));
}

// A jump is one step that is much faster than those around it, or one row that lies apart. A motion that
// begins smoothly after a rest has no jump.
TEST(MotionPath, SaysWhereAPathJumps) {
    const MeshScenes files;
    const auto path_of = [&](const auto& place) {
        std::string text = "t,x,y,z\n";
        for (int i = 0; i < 100; ++i) text += fmt::format("{},0,0,{}\n", 0.01 * i, place(i));
        return complaint(files, text);
    };
    const auto wave = [](int i) { return 0.01 * std::sin(0.3 * i); };
    EXPECT_EQ(path_of(wave), "none");
    EXPECT_EQ(path_of([](int i) { return i < 50 ? 0.0 : 1e-6 * std::pow(i - 50, 3); }), "none");
    EXPECT_EQ(path_of([](int) { return 0.0; }), "none");
    EXPECT_EQ(path_of([](int i) { return i % 25 < 5 ? 0.01 * std::pow(std::sin(pi * (i % 25) / 5), 2) : 0; }),
              "none");
    EXPECT_THAT(path_of([&](int i) { return wave(i) + (i >= 40 ? 0.5 : 0); }),
                tells({"path.csv:42", "jumps by 0.5"}));
    EXPECT_THAT(path_of([&](int i) { return wave(i) + (i == 40 ? 0.5 : 0); }),
                tells({"path.csv:42", "jumps by 0.5"}));
}

// Rates and angles follow from the integral of 10u^3 - 15u^4 + 6u^5, which is 1/2 over the rise.
TEST(BodyTurn, TurnsByTheIntegralOfItsRate) {
    BodyTurn turn;
    turn.rate = 3, turn.from = 0.5, turn.over = 0.4, turn.until = 2;
    EXPECT_EQ(turn.angle_at(0.5), 0);
    EXPECT_DOUBLE_EQ(turn.rate_at(0.7), 1.5);
    EXPECT_DOUBLE_EQ(turn.angle_at(0.9), 3 * 0.2);
    EXPECT_DOUBLE_EQ(turn.angle_at(1.9), 3 * (0.2 + 1.0));
    EXPECT_NEAR(turn.rate_at(2.2), 1.5, 1e-13);
    EXPECT_NEAR(turn.angle_at(2.4), 3 * 1.5, 1e-14);
    EXPECT_NEAR(turn.angle_at(9), 3 * 1.5, 1e-13);
    EXPECT_EQ(turn.rate_at(9), 0);
    constexpr double dt = 1e-5;
    for (int k = 1; k < 300; ++k) {
        const double t = 0.01 * k;
        EXPECT_NEAR((turn.angle_at(t + dt) - turn.angle_at(t - dt)) / (2 * dt), turn.rate_at(t), 1e-7) << t;
    }
}

TEST(BodyTurn, MayBeginAtOnceAndGoOnForEver) {
    BodyTurn turn;
    turn.rate = -2;
    EXPECT_EQ(turn.rate_at(0), -2);
    EXPECT_EQ(turn.angle_at(0), 0);
    EXPECT_EQ(turn.angle_at(1e6), -2e6);
    EXPECT_EQ(turn.rate_at(-1), 0);
    EXPECT_EQ(turn.angle_at(-1), 0);
}

}  // namespace
}  // namespace grainreel
