#include "engine/measure/surface/spectrum.hpp"

#include <cmath>
#include <complex>
#include <numeric>
#include <unsupported/Eigen/FFT>

#include "engine/base/error.hpp"
#include "engine/measure/measures.hpp"

namespace grainreel {

struct Spectrum::Plan {
    explicit Plan(std::size_t count) : bins(count), in(2 * count, 0) {
        transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    }

    const std::size_t bins;
    Eigen::FFT<double> transform;  // keeps its twiddles
    std::vector<double> in;
    std::vector<std::complex<double>> out;
};

Spectrum::Spectrum(std::size_t bins) : plan_(std::make_unique<Plan>(bins)) {}
Spectrum::~Spectrum() = default;
Spectrum::Spectrum(Spectrum&&) noexcept = default;
Spectrum& Spectrum::operator=(Spectrum&&) noexcept = default;

DominantWave Spectrum::dominant(const std::vector<double>& heights, double width) {
    const std::size_t bins = plan_->bins;
    GRAINREEL_CHECK(heights.size() == bins);
    const double mean = mean_height_of(heights), variance = variance_of(heights);
    for (std::size_t j = 0; j < bins; ++j) plan_->in[j] = heights[j] - mean;
    plan_->transform.fwd(plan_->out, plan_->in);
    std::size_t dominant = 0;
    double largest = 0;
    for (std::size_t k = 1; k <= bins / 2; ++k) {
        const double power = std::norm(plan_->out[k]);
        if (power > largest) largest = power, dominant = k;
    }
    if (dominant == 0 || variance == 0) return {kNoValue, kNoValue};
    const auto count = static_cast<double>(bins);
    return {2 * width / static_cast<double>(dominant), 2 * largest / (count * count * variance)};
}

double mean_height_of(const std::vector<double>& heights) {
    return std::accumulate(heights.begin(), heights.end(), 0.0) / static_cast<double>(heights.size());
}

double variance_of(const std::vector<double>& heights) {
    const double mean = mean_height_of(heights);
    double sum = 0;
    for (const double h : heights) sum += (h - mean) * (h - mean);
    return sum / static_cast<double>(heights.size());
}

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
