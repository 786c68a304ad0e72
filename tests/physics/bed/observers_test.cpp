// Tests of observers: when they look, and what each column says of three grains with simple numbers.
#include "engine/measure/observers.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/measure/columns.hpp"
#include "engine/measure/drive_observers.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

struct Calls {
    int made = 0, begun = 0, contacts = 0, looks = 0;
};

// An observer of one column, which counts its calls. It is made where the scene asks for the instrument.
template <int number, bool of_contacts>
struct Counting final : Observer {
    static constexpr const char* instrument = number == 1 ? "one" : number == 2 ? "two" : "three";
    static inline Calls calls;
    static std::string name() { return "column_" + std::to_string(number); }
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{name(), "a column"}}, "1", "of a test"}};
    }
    Counting() { ++calls.made; }
    bool needs_contacts() const override { return of_contacts; }
    void begin(const ObservedState&) override { ++calls.begun; }
    void contact(const ObservedState&, const ContactView&) override { ++calls.contacts; }
    void look(const ObservedState&, std::vector<double>& row) override {
        ++calls.looks;
        row.push_back(number);
    }
};
using Plain = Counting<1, false>;
using First = Counting<2, true>;
using Second = Counting<3, true>;

// Three grains of two species on a raised floor: two small ones side by side and a big one above them.
struct Bed {
    Scene scene;
    Clock clock{1e-5, 1000, 0.25};
    Grains grains;
    Traffic traffic;

    Bed() {
        scene.species.resize(2);
        scene.species[0].name = "small";
        scene.species[0].diameter.mean = 2;
        scene.species[1].name = "big";
        scene.species[1].diameter.mean = 4;
        scene.species[0].count = 2;
        scene.species[1].count = 1;
        scene.container.shape = Container::Shape::box;
        scene.container.half_width = 6;
        scene.container.depth = 8;
        scene.container.height = 20;
        scene.drive.direction = {0, 0, 1};
        scene.drive.present = true;
        scene.drive.frequency = 100;
        scene.drive.amplitude = 1e-4;
        grains.add(0, 0, {0, -1, 2}, 1, 1);
        grains.add(2, 1, {0, 0, 5}, 2, 1);
        grains.add(1, 0, {0, 1, 2}, 1, 1);
        grains.motion[1].velocity = {3, 0, 4};
        grains.motion[2].spin = {0, 2, 0};
        grains.wall_work[0] = 7;
        traffic.work_out = 3, traffic.energy_in = 20, traffic.energy_out = 5;
    }
    ObservedState moment(std::int64_t step = 2500) const {
        return {scene, clock, grains, step, {0, 0, -10}, 0, {{0, 0, 0.5}, {0, 0, 0}, 0}, 100, traffic};
    }
};

ContactView touch(std::int32_t second, double overlap, double force, double energy) {
    ContactView c{};
    c.tangential = c.point = Vec3::Zero();
    c.normal = {0, 0, 1};
    c.second = second;
    c.overlap = overlap;
    c.smaller_radius = 1;
    c.normal_force = force;
    c.stored_energy = energy;
    return c;
}

// Shows three contacts: a pair, a wall, and a pair that touches without force.
void three_contacts(const std::function<void(const ContactView&)>& see) {
    see(touch(1, 0.01, 5, 0.5));
    see(touch(-1, 0.03, 5, 0.25));
    see(touch(2, 0.02, 0, 0));
}

Observers those_of(const std::vector<std::string>& instruments) {
    Plain::calls = First::calls = Second::calls = {};
    Scene scene;
    scene.output.instruments = instruments;
    return {{entry_of<Plain>(), entry_of<First>(), entry_of<Second>()}, scene, Plan()};
}

// Sums the heights (m) of the floor at every third step, and counts the moments.
struct Gathering final : Observer {
    static std::vector<ColumnGroup> columns(const Scene&) {
        return {{{{"sum_m", "sum", Dimension::length}, {"moments", "moments"}}, "m, 1", "of a test"}};
    }
    std::int64_t gathers_after(std::int64_t step) const override { return (step / 3 + 1) * 3; }
    void start(const ObservedState& m) override { sum = 1000 + static_cast<double>(m.step), moments = 0; }
    void gather(const ObservedState& m) override { sum += m.floor_height(), moments += 1; }
    void look(const ObservedState&, std::vector<double>& row) override {
        row.insert(row.end(), {sum, moments});
    }
    void save(std::ostream& out) const override { write_value(out, sum), write_value(out, moments); }
    void load(const ObservedState&, Bytes& in) override {
        read_value(in, sum), read_value(in, moments);
        if (!(moments >= 0)) in.fail();
    }
    double sum = 0, moments = 0;
};

Observers gathering() {
    return {{entry_of<Gathering>(), entry_of<observers::Times>()}, Scene(), Plan()};
}
std::string saved(const Observers& observers) {
    std::ostringstream out;
    observers.save(out);
    return out.str();
}

TEST(Observers, VisitContactsOnceAMoment) {
    const Bed bed;
    Observers all = those_of({"one", "two", "three"});
    int visits = 0;
    for (int looks = 1; looks <= 2; ++looks) {
        const Measures m = all.look(bed.moment(), [&](const auto& see) {
            ++visits;
            three_contacts(see);
        });
        EXPECT_EQ(m.values(), (std::vector<double>{1, 2, 3}));
        EXPECT_EQ(visits, looks);
        EXPECT_EQ(First::calls.contacts, 3 * looks);
        EXPECT_EQ(Second::calls.contacts, 3 * looks);
        EXPECT_EQ(Plain::calls.contacts, 0);
        EXPECT_EQ(First::calls.begun, looks);
    }
}

TEST(Observers, ThatNobodyWantsAreNotMade) {
    const Bed bed;
    Observers one = those_of({"one"});
    const Measures m = one.look(bed.moment(), [](const auto&) { ADD_FAILURE() << "contacts were visited"; });
    EXPECT_EQ(m.names(), std::vector<std::string>{"column_1"});
    EXPECT_EQ(Plain::calls.looks, 1);
    EXPECT_EQ(First::calls.made, 0);
    EXPECT_EQ(Second::calls.made, 0);
    EXPECT_EQ(those_of({}).look(bed.moment(), [](const auto&) { ADD_FAILURE(); }).names().size(), 0u);
}

TEST(Observers, AreAskedForOneColumnAlone) {
    const Bed bed;
    Observers all = those_of({"one", "two"});
    EXPECT_EQ(all.look(
                  bed.moment(), [](const auto&) { ADD_FAILURE(); }, "column_1"),
              1);
    EXPECT_EQ(First::calls.looks, 0);
    EXPECT_EQ(all.look(bed.moment(), three_contacts, "column_2"), 2);
}

constexpr auto no_contacts = [](const auto&) { ADD_FAILURE() << "contacts were visited"; };

TEST(Observers, GatherAtTheStepsTheySay) {
    const Bed bed;
    Observers all = gathering();
    all.start(bed.moment(0), no_contacts);
    EXPECT_EQ(all.gathers_after(0), 3);
    EXPECT_EQ(all.gathers_after(2), 3);
    EXPECT_EQ(all.gathers_after(3), 6);
    for (std::int64_t step = 1; step <= 7; ++step) all.gather(bed.moment(step), no_contacts);
    EXPECT_EQ(all.look(bed.moment(7), no_contacts, "sum_m"), 1000 + 2 * 0.5);
    EXPECT_EQ(all.look(bed.moment(7), no_contacts, "moments"), 2);
    EXPECT_EQ(those_of({"one"}).gathers_after(0), Observer::kNever);
}

TEST(Observers, TakeUpWhatTheyHadGathered) {
    const Bed bed;
    Observers first = gathering(), next = gathering(), fresh = gathering();
    first.start(bed.moment(0), no_contacts);
    first.gather(bed.moment(3), no_contacts);
    const std::string bytes = saved(first);
    Bytes in(bytes);
    next.load(bed.moment(5), in);
    EXPECT_FALSE(in.failed());
    next.start(bed.moment(5), no_contacts);  // no observer is left to start
    EXPECT_EQ(next.look(bed.moment(5), no_contacts).values(),
              first.look(bed.moment(5), no_contacts).values());
    EXPECT_EQ(saved(next), bytes);
    // This is the state of a run that measured nothing with these observers.
    Bytes nothing("");
    fresh.load(bed.moment(5), nothing);
    fresh.start(bed.moment(5), no_contacts);
    EXPECT_EQ(fresh.look(bed.moment(5), no_contacts, "sum_m"), 1005);
}

TEST(Observers, BelieveNothingThatWasSaved) {
    const Bed bed;
    Observers first = gathering();
    first.start(bed.moment(0), no_contacts);
    const std::string bytes = saved(first);
    const auto is_taken = [&](const std::string& what) {
        Observers next = gathering();
        Bytes in(what);
        next.load(bed.moment(5), in);
        return !in.failed();
    };
    EXPECT_TRUE(is_taken(bytes));
    for (std::size_t size = 1; size < bytes.size(); ++size) EXPECT_FALSE(is_taken(bytes.substr(0, size)));
    EXPECT_FALSE(is_taken(bytes + bytes)) << "twice";
    std::string huge = bytes, negative = bytes;
    huge[7] = '\x7f';  // in the length of the name
    EXPECT_FALSE(is_taken(huge));
    negative.back() = '\xbf';  // in the sign of the number of moments
    EXPECT_FALSE(is_taken(negative));
    // What observers of another program gathered is passed over.
    std::string other = bytes;
    other[8] = 'x';
    EXPECT_TRUE(is_taken(other));
}

TEST(Observers, GiveEveryColumnOfThreeGrains) {
    const Bed bed;
    Plan plan;
    plan.clock = bed.clock;
    Observers all(all_observers(), bed.scene, plan);
    const Measures m = all.look(bed.moment(), three_contacts);
    const double small = 4.0 / 3 * std::numbers::pi, big = 8 * small, mass = 2 * small + big;  // kg
    const double kinetic = 0.5 * big * 25, rotational = 0.5 * 0.4 * small * 4;
    const double high = 10 * (2 * small * 2 + big * 5);
    const double nan = std::nan("");
    const double u = 2.5 / 3, grown = u * u * u * (10 - 15 * u + 6 * u * u);
    // The bed height of three centres: the index 0.95 * 2 gives the second one, 1.5 above the floor.
    const std::vector<std::pair<std::string, double>> expected{
        {"step", 2500},
        {"time_s", 0.025},
        {"phase_turns", 0.75},
        {"cycles", 2.5},
        {"kinetic_J", kinetic},
        {"rotational_J", rotational},
        {"gravitational_J", high},
        {"elastic_J", 0.75},
        {"wall_work_J", 7 + 3},
        {"lost_J", 100 + 20 - 5 + 7 + 3 - kinetic - rotational - high - 0.75},
        {"centre_x_m", 0},
        {"centre_y_m", 0},
        {"centre_z_m", (2 * small * 2 + big * 5) / mass},
        {"small_centre_x_m", 0},
        {"small_centre_y_m", 0},
        {"small_centre_z_m", 2},
        {"small_height_m", 1.5},
        {"big_centre_x_m", 0},
        {"big_centre_y_m", 0},
        {"big_centre_z_m", 5},
        {"big_height_m", 4.5},
        {"height_difference", (4.5 - 1.5) / 1.5},
        {"big_above_small", 1},
        {"big_in_top_quarter", 1},
        {"big_in_bottom_quarter", 0},
        {"big_at_walls", 0},
        // All three are neighbours of each other, and two of three pairs are unlike. By chance, pairs weigh
        // (r + r)^2: the like one 4 and each unlike one 9.
        {"unlike_neighbours", (2.0 / 3) / (18.0 / 22)},
        {"lacey", nan},
        // There are two samples: one has one small grain, the other has one of each.
        {"intensity", (1.0 / 9 + 1.0 / 36) / 2 / (2.0 / 9)},
        {"contact_number", (2 + 1) / 3.0},
        {"fabric_anisotropy", 1},
        {"fabric_vertical", 1},
        {"largest_overlap", 0.03},
        {"floor_position_m", 0.5},
        {"bed_periods", 1},
        {"period_difference_m", 0},
        {"drive_frequency_Hz", 100},
        // The drive still grows, over three periods.
        {"drive_g_level", grown * 1e-4 * std::pow(2 * std::numbers::pi * 100, 2) / 10},
        {"bed_top_m", 1.5},
        // The lower halves of the small grains reach up to there.
        {"bed_solid_fraction", small / (12 * 8 * 1.5)}};
    ASSERT_EQ(m.names().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& [name, value] = expected[i];
        EXPECT_EQ(m.names()[i], name);
        if (std::isnan(value))
            EXPECT_TRUE(std::isnan(m.at(name))) << name;
        else
            EXPECT_NEAR(m.at(name), value, 1e-12 * std::max(1.0, std::abs(value))) << name;
    }
}

TEST(Observers, OfSegregationGiveNothingForOneSpecies) {
    Bed bed;
    bed.scene.species.resize(1);
    bed.grains.species = {0, 0, 0};
    Plan plan;
    plan.clock = bed.clock;
    Observers all(all_observers(), bed.scene, plan);
    const Measures m = all.look(bed.moment(), three_contacts);
    for (const char* name :
         {"height_difference", "big_above_small", "big_in_top_quarter", "big_in_bottom_quarter",
          "big_at_walls", "unlike_neighbours", "lacey", "intensity"})
        EXPECT_TRUE(std::isnan(m.at(name))) << name;
    EXPECT_NEAR(m.at("small_height_m"), 2.5, 1e-12);
}

}  // namespace
}  // namespace grainreel
