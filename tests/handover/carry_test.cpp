// What is carried to another engine, what is changed by name, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/handover/carry.hpp"
#include "engine/handover/decks/decks.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;

const std::string head = test::SmallScene()
                             .beads(50, "ball")
                             .box("40 mm", "40 mm", "60 mm")
                             .more("[drive]\nfrequency = \"20 Hz\"\namplitude = \"1 mm\"\n")
                             .lasts("0.5 s")
                             .text();
const std::string exact = "[contact]\nlaw = \"spring-dashpot\"\n";

CarriedScene carried_of(const std::string& text, CarryRequest request = {}) {
    const Scene scene = read_scene_text(text, "s.toml");
    return carry(scene, make_plan(scene), request);
}

std::string refusals(const std::string& text, CarryRequest request = {}) {
    std::string all;
    try {
        throw_refusals(carried_of(text, request), [&](const std::string& line) { all += line + "\n"; });
    } catch (const UserError& error) {
        return all + error.what();
    }
    return {};
}

TEST(Carry, RefusesALawThatTheEngineHasNotWithItsLineAndItsFigures) {
    const std::string text = refusals("[contact]\nlaw = \"walton-braun\"\n" + head);
    EXPECT_THAT(text, HasSubstr("s.toml:2:"));
    EXPECT_THAT(text, HasSubstr("--accept law"));
    EXPECT_THAT(text, HasSubstr("0.4 mm"));
    EXPECT_THAT(text, HasSubstr("40 %"));
    EXPECT_THAT(text, HasSubstr("incremental-slip"));
    EXPECT_THAT(text, HasSubstr("--law edinburgh"));
}

TEST(Carry, KeepsStiffnessAndRestitutionOfALawThatIsChanged) {
    CarryRequest request;
    request.accept_law = true;
    const std::string text = "[contact]\nrestitution = 0.8\nstiffness = 5000\n" + head;
    const CarriedScene carried = carried_of(text, request);
    EXPECT_TRUE(carried.refusals.empty());
    const CarriedPair& pair = carried.between(0, 0);
    EXPECT_EQ(pair.law, CarriedLaw::spring_dashpot);
    EXPECT_EQ(pair.stiffness, 5000);
    EXPECT_EQ(pair.tangential, 0.8 * 5000);
    EXPECT_NEAR(pair.restitution, 0.8, 1e-9);
    EXPECT_EQ(pair.tangential_damping, 0);
    EXPECT_EQ(carried.surfaces[0].with[0].effective_mass, 2 * pair.effective_mass);
}

TEST(Carry, ChangedArmsAreToldAtTheirLine) {
    CarryRequest request;
    request.accept_law = true;
    const CarriedScene carried = carried_of("[contact]\nfriction = 0.3\narms = \"radius\"\n" + head, request);
    const auto is_of_arms = [](const auto& change) {
        return change.what.find("not at the full radius") != std::string::npos;
    };
    const auto change = std::find_if(carried.changes.begin(), carried.changes.end(), is_of_arms);
    ASSERT_NE(change, carried.changes.end());
    EXPECT_THAT(change->where, HasSubstr("s.toml:3:"));
}

TEST(Carry, TellsAllRefusalsAtOnce) {
    CarryRequest request;
    const std::string text = refusals(
        "[contact]\nlaw = \"walton-braun\"\n" + head +
            "[[feed]]\nrate = 5\ncount = 3\nlow = [-0.01, -0.01, 0.05]\nhigh = [0.01, 0.01, 0.055]\n",
        request);
    EXPECT_THAT(text, HasSubstr("walton-braun"));
    EXPECT_THAT(text, HasSubstr("rate of a feed"));
}

// `movie` has --engine, where `handover` has --to.
TEST(Carry, RefusalsNameTheOptionOfTheVerbInUse) {
    const std::string feed =
        "[[feed]]\nrate = 5\ncount = 3\nlow = [-0.01, -0.01, 0.05]\nhigh = [0.01, 0.01, 0.055]\n";
    const std::string law = "[contact]\nlaw = \"walton-braun\"\n";
    CarryRequest request;
    EXPECT_THAT(refusals(law + head + feed, request), HasSubstr("--to liggghts --law edinburgh"));
    request.engine_option = "--engine";
    request.pack_option = "handover --pack-there";
    const std::string text = refusals(law + head + feed, request);
    EXPECT_THAT(text, HasSubstr("--engine liggghts --law edinburgh"));
    EXPECT_THAT(text, HasSubstr("for); use --engine liggghts"));
    EXPECT_THAT(text, testing::Not(HasSubstr("--to")));
    request.edinburgh = true;
    EXPECT_THAT(refusals(law + head, request), tells({"--law edinburgh", "LIGGGHTS", "--engine"}));
    request.edinburgh = false;
    request.packs_above = 10;
    EXPECT_THAT(refusals("[contact]\nlaw = \"hertz\"\n" + head, request),
                HasSubstr("pack here (handover --pack-there above"));
}

TEST(Carry, TakesTheContainersFrameWhereAllMovesTogether) {
    EXPECT_EQ(carried_of(exact + head).frame, ReferenceFrame::container);
    const std::string floor = exact + head;
    CarriedScene carried = carried_of(exact + "[[wall]]\npoint = [0, 0, 0.05]\nnormal = [0, 0, -1]\n" + head);
    EXPECT_EQ(carried.frame, ReferenceFrame::lab);
}

TEST(Carry, KeepsEdinburghToOneRank) {
    CarryRequest request;
    request.engine = PeerEngine::liggghts;
    request.edinburgh = true;
    const CarriedScene one = carried_of("[contact]\nrestitution = 0.7\nstiffness = 5000\n" + head, request);
    EXPECT_TRUE(one.refusals.empty());
    EXPECT_EQ(one.between(0, 0).law, CarriedLaw::edinburgh);
    EXPECT_NEAR(one.between(0, 0).unloading, 5000 / 0.49, 1e-6);
    request.ranks = 2;
    EXPECT_THAT(refusals("[contact]\nrestitution = 0.7\n" + head, request), HasSubstr("--ranks 1"));
}

TEST(Carry, DumpsAtThePictures) {
    CarryRequest request;
    request.dumps = {100, 7, 100, 2000000000};
    const CarriedScene carried = carried_of(exact + head, request);
    EXPECT_THAT(carried.dumps, testing::ElementsAre(0, 7, 100, carried.plan.steps));
}

// The corners of the first feed's region in the deck of LIGGGHTS.
std::array<double, 6> region_of_feed(const std::string& text) {
    CarryRequest request;
    request.engine = PeerEngine::liggghts;
    CarriedScene carried = carried_of(text, request);
    carried.low = Vec3(-1, -1, -1);  // m, room for the walls; the start sets it otherwise
    carried.high = Vec3(1, 1, 1);
    const std::string deck = liggghts_deck(carried), begin = "region feed0 block ";
    std::istringstream numbers(deck.substr(deck.find(begin) + begin.size()));
    std::array<double, 6> corners{};
    for (double& one : corners) numbers >> one;
    return corners;
}

// LIGGGHTS looks at other grains when it adds one, but not at walls. Grains have a radius of 2 mm.
TEST(Feeds, AreClearOfWallsInLiggghts) {
    const std::string feed = "[[feed]]\nspecies = \"ball\"\nrate = \"100 1/s\"\n";
    const std::array<double, 6> box = region_of_feed(head + exact + feed);
    for (const int k : {0, 2}) {
        EXPECT_NEAR(box[static_cast<std::size_t>(k)], -(0.02 - 0.002), 1e-12) << k;
        EXPECT_NEAR(box[static_cast<std::size_t>(k) + 1], 0.02 - 0.002, 1e-12) << k;
    }
    EXPECT_LE(box[5], 0.06 - 0.002 + 1e-12);

    const std::array<double, 6> inside =
        region_of_feed(head + exact + feed + "low = [-0.01, -0.01, 0.03]\nhigh = [0.01, 0.01, 0.05]\n");
    EXPECT_EQ(inside, (std::array<double, 6>{-0.01, 0.01, -0.01, 0.01, 0.03, 0.05}));

    std::string round = head + exact + feed;
    const std::string square = "shape = \"box\"\nwidth = \"40 mm\"\ndepth = \"40 mm\"\n";
    round.replace(round.find(square), square.size(), "shape = \"cylinder\"\ndiameter = \"40 mm\"\n");
    const std::array<double, 6> cylinder = region_of_feed(round);
    EXPECT_NEAR(std::hypot(cylinder[1], cylinder[3]), 0.02 - 0.002, 1e-12);
}

}  // namespace
}  // namespace grainreel
