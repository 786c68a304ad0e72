#include "engine/measure/surface/subharmonics.hpp"

#include <complex>

#include "engine/base/error.hpp"
#include "engine/measure/no_value.hpp"
#include "engine/measure/surface/spectrum.hpp"

namespace grainreel {

Subharmonics subharmonics_of(const std::vector<const std::vector<double>*>& surfaces) {
    GRAINREEL_CHECK(surfaces.size() == kComparedPeriods);
    const std::size_t bins = surfaces.front()->size();
    std::vector<double> mean;
    for (const std::vector<double>* const h : surfaces) {
        GRAINREEL_CHECK(h->size() == bins);
        mean.push_back(mean_height_of(*h));
    }
    double power = 0, half = 0, quarter = 0;
    for (std::size_t j = 0; j < bins; ++j) {
        std::complex<double> a = 0, b = 0, turn = 1;  // turn = (-i)^n
        for (std::size_t n = 0; n < kComparedPeriods; ++n) {
            const double h = (*surfaces[n])[j] - mean[n];
            power += h * h / kComparedPeriods;
            a += turn * turn * h / static_cast<double>(kComparedPeriods);
            b += turn * h / static_cast<double>(kComparedPeriods);
            turn *= std::complex<double>(0, -1);
        }
        half += std::norm(a);
        quarter += 2 * std::norm(b);
    }
    if (power == 0) return {kNoValue, kNoValue};
    return {half / power, quarter / power};
}

}  // namespace grainreel
