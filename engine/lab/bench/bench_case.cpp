#include "engine/lab/bench/bench_case.hpp"

#include <cmath>

#include "engine/lab/bench/peers_cases.hpp"
#include "engine/lab/bench/rest_case.hpp"
#include "engine/lab/bench/scene_cases.hpp"

namespace grainreel {

const std::vector<BenchCase>& bench_cases() {
    static const std::vector<BenchCase> all = [] {
        std::vector<BenchCase> cases = peers_cases();
        for (BenchCase& scene : scene_cases()) cases.push_back(scene);
        cases.push_back(rest_case());
        return cases;
    }();
    return all;
}

BenchBed copied(const BenchBed& bed, const Grains& grains, double side, int k) {
    BenchBed whole{bed.plan, bed.around, {}};
    for (Face& face : whole.around.faces) {
        if (std::abs(face.normal.z()) < 0.5) face.point.head<2>() *= k;
    }
    const auto n = static_cast<std::int32_t>(grains.size());
    whole.grains.reserve(grains.size() * k * k);
    const double first = -0.5 * (k - 1);
    for (int copy = 0; copy < k * k; ++copy) {
        const Vec3 shift(side * (first + copy % k), side * (first + copy / k), 0);
        for (std::int32_t i = 0; i < n; ++i) {
            whole.grains.id.push_back(copy * n + grains.id[i]);
            whole.grains.species.push_back(grains.species[i]);
            whole.grains.place.push_back(grains.place[i]);
            whole.grains.place.back().position += shift;
            whole.grains.motion.push_back(grains.motion[i]);
            whole.grains.load.push_back({});
            whole.grains.wall_work.push_back(0);
        }
    }
    return whole;
}

}  // namespace grainreel
