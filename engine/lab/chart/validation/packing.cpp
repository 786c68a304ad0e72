#include "engine/lab/chart/validation/packing.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/random.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/small_world.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {

namespace {

constexpr double kDiameter = 0.004, kDensity = 2500, kStiffness = 1e4;  // m, kg/m3, N/m

double natural_frequency() {  // 1/s
    return std::sqrt(kStiffness / (kDensity * sphere_volume(kDiameter / 2)));
}

// The grains, first with random centres, between walls at +- edge/2 in y and z.
struct Crowd {
    const JammedPacking& setting;
    SmallWorld world;
    double edge = 0;

    explicit Crowd(const JammedPacking& packing)
        : setting(packing),
          world(latching_pair(kStiffness, 1, packing.friction, packing.precision),
                0.1 / natural_frequency()) {
        world.plan.wall = {latching_pair(kStiffness, 1, 0, packing.precision)};
        edge = math::cbrt(setting.grains * sphere_volume(kDiameter / 2) / setting.solid_fraction);
        const double room = edge / 2 - kDiameter / 2;
        Random centres(setting.seed, Stream::centres);
        for (int k = 0; k < setting.grains; ++k) {
            const double x = centres.between(-edge / 2, edge / 2), y = centres.between(-room, room);
            world.add(Vec3(x, y, centres.between(-room, room)), Vec3::Zero(), {kDiameter / 2, kDensity});
        }
        for (const Vec3& normal : {Vec3::UnitY().eval(), Vec3::UnitZ().eval()}) {
            world.add_plane(-edge / 2 * normal, normal);
            world.add_plane(edge / 2 * normal, -normal);
        }
        world.around.period = edge;
        world.around.skin = 0.3 * kDiameter;
        world.start();
    }
    // Multiplies all radii by `factor`. Neighbour lists stay valid when grains shrink, so contacts keep their
    // histories.
    void shrink(double factor) {
        for (std::size_t i = 0; i < world.grains.size(); ++i)
            world.grains.set_radius(i, factor * world.grains.place[i].radius, kDensity);
    }
    Vec3 inner() const {  // m, half the extents of the part that is measured
        const double half = edge / 2 - setting.margin * kDiameter;
        return {edge / 2, half, half};
    }
};

bool lies_in(const Vec3& point, const Vec3& inner) {
    return std::abs(point.y()) < inner.y() && std::abs(point.z()) < inner.z();
}

double unbalanced(const Crowd& crowd) {
    double forces = 0, contacts = 0, squares = 0;
    crowd.world.loop->visit_contacts(crowd.world.step, [&](const ContactView& c) {
        forces += c.normal_force;
        contacts += c.normal_force > 0;
    });
    for (const Load& load : crowd.world.grains.load) squares += load.force.squaredNorm();
    const double grains = static_cast<double>(crowd.world.grains.size());
    return contacts > 0 ? std::sqrt(squares / grains) / (forces / contacts) : 0;
}

// Runs until the forces balance. drag is in units of the natural frequency.
void rest(Crowd& crowd, double drag, double balance, int most_steps) {
    constexpr int steps_per_look = 500;
    for (int done = 0; done < most_steps; done += steps_per_look) {
        crowd.world.run(steps_per_look, drag * natural_frequency());
        if (unbalanced(crowd) < balance) return;
    }
}

struct TouchingPair {
    std::int32_t first, second;  // second below 0: a wall
};

// Rattlers: grains with fewer than `needed` contacts, where contacts with other rattlers do not count.
std::vector<bool> rattlers(const std::vector<TouchingPair>& contacts, std::size_t grains, int needed) {
    std::vector<bool> loose(grains, false);
    for (bool found = true; found;) {
        std::vector<int> count(grains, 0);
        for (const TouchingPair& c : contacts) {
            if (loose[c.first] || (c.second >= 0 && loose[c.second])) continue;
            ++count[c.first];
            if (c.second >= 0) ++count[c.second];
        }
        found = false;
        for (std::size_t i = 0; i < grains; ++i) {
            if (loose[i] || count[i] >= needed) continue;
            loose[i] = found = true;
        }
    }
    return loose;
}

PackingState state_of(const Crowd& crowd) {
    const Grains& grains = crowd.world.grains;
    const Vec3 inner = crowd.inner();
    const double volume = 8 * inner.prod();
    PackingState state;
    std::vector<TouchingPair> contacts;
    crowd.world.loop->visit_contacts(crowd.world.step, [&](const ContactView& c) {
        if (c.normal_force <= 0) return;
        contacts.push_back({c.first, c.second});
        if (c.second < 0 || !lies_in(c.point, inner)) return;
        const double apart = grains.place[c.first].radius + grains.place[c.second].radius - c.overlap;
        state.pressure += c.normal_force * apart / (3 * volume) * kDiameter / kStiffness;
    });
    // Without friction it takes four contacts to hold a grain (one more than dimensions), with friction two.
    const std::vector<bool> loose = rattlers(contacts, grains.size(), crowd.setting.friction > 0 ? 2 : 4);
    double inside = 0, held = 0, ends = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Place& p = grains.place[i];
        state.solid_fraction += volume_within(p.position, p.radius, -inner, inner) / volume;
        if (!lies_in(p.position, inner)) continue;
        inside += 1;
        held += !loose[i];
    }
    for (const TouchingPair& c : contacts) {
        if (c.second < 0 || loose[c.first] || loose[c.second]) continue;
        for (const std::int32_t i : {c.first, c.second}) ends += lies_in(grains.place[i].position, inner);
    }
    state.contacts = ends / held;
    state.rattlers = 1 - held / inside;
    state.unbalanced = unbalanced(crowd);
    return state;
}

}  // namespace

std::vector<PackingState> decompress(const JammedPacking& packing, int states) {
    Crowd crowd(packing);
    rest(crowd, 1, 0.02, 10000);  // the quench
    rest(crowd, 0.05, 1e-3, 40000);
    std::vector<PackingState> all = {state_of(crowd)};
    double excess = 0.02;  // solid fraction above jamming, unknown at first
    while (static_cast<int>(all.size()) < states) {
        const double now = all.back().solid_fraction;
        crowd.shrink(math::cbrt(1 - packing.share * excess / now));
        rest(crowd, 0.05, 1e-3, 40000);
        const PackingState before = all.back(), after = state_of(crowd);
        if (after.unbalanced > 0.01 || after.rattlers > 0.5 || after.pressure >= before.pressure) break;
        all.push_back(after);
        excess = (before.solid_fraction - after.solid_fraction) * after.pressure /
                 (before.pressure - after.pressure);
    }
    return all;
}

namespace {

// A least-squares fit of y = at_zero + slope x.
struct Line {
    double at_zero = 0, slope = 0;
};
Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        sx += x[k], sy += y[k];
        sxx += x[k] * x[k], sxy += x[k] * y[k];
    }
    const double determinant = n * sxx - sx * sx;
    return {(sy * sxx - sx * sxy) / determinant, (n * sxy - sx * sy) / determinant};
}

}  // namespace

JammingPoint jamming_point(const std::vector<PackingState>& states) {
    constexpr double law_holds_below = 0.003;  // p d / K
    std::vector<double> pressure, root, solid, contacts;
    for (std::size_t k = 0; k < states.size(); ++k) {
        const PackingState& s = states[k];
        if (s.pressure > law_holds_below && k + 3 < states.size()) continue;
        pressure.push_back(s.pressure), root.push_back(std::sqrt(s.pressure));
        solid.push_back(s.solid_fraction), contacts.push_back(s.contacts);
    }
    const Line of_solid = line_through(pressure, solid), of_contacts = line_through(root, contacts);
    return {of_solid.at_zero, of_contacts.at_zero, of_contacts.slope / std::sqrt(of_solid.slope)};
}

double volume_within(const Vec3& centre, double radius, const Vec3& low, const Vec3& high) {
    const auto beyond = [&](int axis) {
        return centre[axis] + radius <= low[axis] || centre[axis] - radius >= high[axis];
    };
    const auto inside = [&](int axis) {
        return centre[axis] - radius >= low[axis] && centre[axis] + radius <= high[axis];
    };
    if (beyond(1) || beyond(2)) return 0;
    if (inside(1) && inside(2)) return sphere_volume(radius);
    // The volume is summed over slices across y, each the part of a disc between two levels of z.
    constexpr int slices = 400;
    const double first = std::max(low.y() - centre.y(), -radius);
    const double last = std::min(high.y() - centre.y(), radius), width = (last - first) / slices;
    double volume = 0;
    for (int k = 0; k < slices; ++k) {
        const double y = first + (k + 0.5) * width, disc = std::sqrt(radius * radius - y * y);
        const auto below = [disc](double z) {
            const double cut = std::clamp(z, -disc, disc);
            return cut * std::sqrt(std::max(0.0, disc * disc - cut * cut)) +
                   disc * disc * math::asin(std::clamp(cut / disc, -1.0, 1.0));
        };
        volume += (below(high.z() - centre.z()) - below(low.z() - centre.z())) * width;
    }
    return volume;
}

// The comparison of jammed packings with O'Hern et al. (2003), Silbert (2010) and Onoda & Liniger (1990).

namespace {

const std::vector<double> kFrictions = {0, 0.1, 0.5, 10};
int packing_seeds(bool quick) {
    return quick ? 1 : 3;
}

// The packing for one comparison. Without friction it has more grains, because the published values are
// precise there.
JammedPacking packing_of(double friction, int seed, bool quick) {
    JammedPacking packing;
    packing.friction = friction;
    packing.grains = quick ? 1500 : friction > 0 ? 3000 : 6000;
    packing.margin = quick ? 2.5 : friction > 0 ? 3 : 4;
    packing.share = friction > 0 ? 0.25 : 0.4;
    packing.seed = static_cast<std::uint64_t>(seed);
    return packing;
}

int states_of(double friction, bool quick) {
    return quick ? 10 : friction > 0 ? 20 : 12;
}

std::vector<PackingState> states_in(const ResultTable& table, double friction, int seed) {
    std::vector<PackingState> states;
    for (const auto& row : table.rows()) {
        if (row.at(0) != number(friction) || row.at(1) != number(seed) || row.at(2) == "end") continue;
        states.push_back(
            {value_in(row, 3), value_in(row, 4), value_in(row, 5), value_in(row, 6), value_in(row, 7)});
    }
    return states;
}

void summarise_packings(const ChartRequest& request, const ResultTable& table) {
    std::string text = "friction,seeds,solid_fraction,error,contacts,error,rise,error\n";
    for (const double friction : kFrictions) {
        std::vector<double> solid, contacts, rise;
        for (int seed = 1; seed <= packing_seeds(request.quick); ++seed) {
            const JammingPoint point = jamming_point(states_in(table, friction, seed));
            solid.push_back(point.solid_fraction), contacts.push_back(point.contacts);
            rise.push_back(point.rise);
        }
        const SeedMean a = seed_mean_of(solid), b = seed_mean_of(contacts), c = seed_mean_of(rise);
        text += fmt::format("{},{},{:.4f},{:.4f},{:.3f},{:.3f},{:.2f},{:.2f}\n", friction, solid.size(),
                            a.mean, a.error, b.mean, b.error, c.mean, c.error);
    }
    replace_file(request.folder / "jamming.csv", text);
}

bool run_packings(const ChartRequest& request, ChartWork& work) {
    ResultTable table(request.folder / "packing.csv",
                      "friction,seed,state,pressure_d_K,solid_fraction,contacts,rattlers,unbalanced", 3);
    for (const double friction : kFrictions) {
        for (int seed = 1; seed <= packing_seeds(request.quick); ++seed) {
            if (!work.next(fmt::format("packing, friction {}, seed {}", friction, seed))) return false;
            if (table.has({number(friction), number(seed), "end"})) continue;
            const auto states =
                decompress(packing_of(friction, seed, request.quick), states_of(friction, request.quick));
            for (std::size_t k = 0; k < states.size(); ++k) {
                const PackingState& s = states[k];
                const std::vector<std::string> key = {number(friction), number(seed),
                                                      number(static_cast<double>(k))};
                if (table.has(key)) continue;
                table.add({key[0], key[1], key[2], number(s.pressure), number(s.solid_fraction),
                           number(s.contacts), number(s.rattlers), number(s.unbalanced)});
            }
            table.add({number(friction), number(seed), "end", "", "", "", "", ""});
        }
    }
    summarise_packings(request, table);
    return true;
}

}  // namespace

const ValidationPart packing_part = {
    [](bool quick) { return kFrictions.size() * static_cast<std::size_t>(packing_seeds(quick)); },
    run_packings};

}  // namespace grainreel
