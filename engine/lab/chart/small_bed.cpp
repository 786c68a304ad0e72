#include "engine/lab/chart/small_bed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "engine/base/mathematics.hpp"
#include "engine/lab/chart/validation/validation.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

// The two species differ only in name, like dyed halves of one bed.
const char* bed_scene() {
    return R"(title = "Small bed of the accuracy chart"
[[species]]
name = "lower"
count = 500
diameter = "4 mm"
density = "2.5 g/cm3"
[[species]]
name = "upper"
count = 500
diameter = "4 mm"
density = "2.5 g/cm3"
[contact]
restitution = 0.8
friction = 0.4
[container]
shape = "box"
width = "40 mm"
depth = "40 mm"
height = "120 mm"
[drive]
frequency = "20 Hz"
g_level = 3
[output]
trajectory = false
)";
}

double default_bed_step() {
    return make_plan(read_scene_text(bed_scene(), "small_bed.toml")).clock.step;
}

std::optional<BedResult> run_bed(const BedSetting& setting, std::uint64_t seed, double duration,
                                 const std::function<bool()>& goes_on) {
    std::vector<std::string> sets = setting.sets;
    sets.push_back(fmt::format("run.seed={}", seed));
    sets.push_back(fmt::format("run.duration={}", duration));
    const Scene scene = read_scene_text(bed_scene(), "small_bed.toml", sets);
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    if (!simulation.pack([&](const PackingProgress&) { return goes_on(); }).finished) return std::nullopt;

    BedResult result;
    std::int64_t looks = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (std::int64_t step = 0; step < plan.steps;) {
        step = std::min(plan.steps, step + plan.clock.steps_per_period / 8);
        if (!goes_on()) return std::nullopt;
        simulation.advance(step);
        if (2 * step < plan.steps) continue;
        const State frame = simulation.frame();
        Vec3 mean = Vec3::Zero();
        for (const Vec3& v : frame.velocity) mean += v / static_cast<double>(frame.size());
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const double share = 1 / static_cast<double>(frame.size());
            result.temperature += share * (frame.velocity[i] - mean).squaredNorm() / 3;
            result.height += share * (frame.position[i].z() - frame.floor().place.z());
        }
        result.contacts += simulation.measure("contact_number");
        ++looks;
    }
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
    result.height /= static_cast<double>(looks);
    result.temperature /= static_cast<double>(looks);
    result.contacts /= static_cast<double>(looks);
    result.cost = taken.count() / static_cast<double>(simulation.grains()) / (duration * 1e6);

    const State frame = simulation.frame();
    std::vector<std::uint8_t> lower;
    for (const std::int32_t s : frame.species) lower.push_back(s == 0);
    result.mixing = lacey_index(take_samples(frame.position, lower));
    return result;
}

namespace {

SeedMean over_seeds(const std::vector<BedRow>& rows, const std::string& setting,
                    double BedResult::*quantity) {
    std::vector<double> values;
    for (const BedRow& row : rows)
        if (row.setting == setting) values.push_back(row.result.*quantity);
    return seed_mean_of(values);
}

}  // namespace

std::vector<BedDifference> bed_differences(const std::vector<BedRow>& rows) {
    std::vector<BedDifference> differences;
    for (const BedRow& row : rows) {
        const auto same = [&](const BedDifference& d) { return d.setting == row.setting; };
        const auto found = std::find_if(differences.begin(), differences.end(), same);
        if (found == differences.end())
            differences.push_back({row.setting, 1});
        else
            ++found->seeds;
    }
    for (BedDifference& d : differences) {
        const auto compare = [&](double BedResult::*quantity, double& difference, double& error) {
            const SeedMean is = over_seeds(rows, d.setting, quantity);
            const SeedMean should = over_seeds(rows, differences[0].setting, quantity);
            difference = 100 * (is.mean / should.mean - 1);
            const double own = d.setting == differences[0].setting ? 0 : is.error;
            error = 100 * math::hypot(own, should.error) / should.mean;
        };
        compare(&BedResult::height, d.height, d.height_error);
        compare(&BedResult::temperature, d.temperature, d.temperature_error);
        compare(&BedResult::contacts, d.contacts, d.contacts_error);
        compare(&BedResult::mixing, d.mixing, d.mixing_error);
        d.cost = over_seeds(rows, d.setting, &BedResult::cost).mean /
                 over_seeds(rows, differences[0].setting, &BedResult::cost).mean;
    }
    return differences;
}

}  // namespace grainreel
