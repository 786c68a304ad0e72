// Normal force: Walton and Braun's latching spring with a restitution that falls with speed (Walton & Braun
// 1986, J. Rheol. 30, 949). It is the law of walton_braun-inl.hpp, but the unloading slope grows with the
// largest force:
//
//   K2 = K1 + S F_max,   F_max = K1 a_max,   e(v) = sqrt(w0 / (w0 + S v)),   w0 = sqrt(K1 / m_eff)
//
// A contact without hardening (S = 0) keeps its constant K2.
#if defined(GRAINREEL_LAWS_WALTON_BRAUN_SPEED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_WALTON_BRAUN_SPEED_INL
#undef GRAINREEL_LAWS_WALTON_BRAUN_SPEED_INL
#else
#define GRAINREEL_LAWS_WALTON_BRAUN_SPEED_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct WaltonBraunSpeed : HardeningSpring<WaltonBraunSpeed> {
    static constexpr bool has_dashpot = false, uses_velocity = false, uses_mass = false, uses_radius = false;
    static constexpr bool weighs_onset = false;

    template <class R>
    struct Parameters {
        R loading;    // N/m, K1
        R unloading;  // N/m, K2 of a contact whose overlap was always small
        R hardening;  // N/m2, S K1

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(loading), visit(unloading), visit(hardening);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        const double k1 = plan.loading_stiffness;
        return {k1, plan.hardening > 0 ? k1 : plan.unloading_stiffness, plan.hardening * k1};
    }

    template <class R>
    using History = WaltonBraun::History<R>;

    // Unloading slope K2 (N/m).
    template <class R>
    static HWY_INLINE R unloading(const Parameters<R>& p, const History<R>& h, const Touch<R>&) {
        return p.unloading + p.hardening * h.largest_overlap;
    }
};

// Normal force: Walton and Braun's latching spring with a restitution from a table e(v). It is the law of
// walton_braun-inl.hpp, but K2 = K1 / e(v)^2 with the speed v = a_max sqrt(K1 / m_eff) of a free impact that
// reaches the largest overlap so far. e(v) is linear between the rows of the table, and constant beyond them.

struct WaltonBraunTable : HardeningSpring<WaltonBraunTable> {
    static constexpr bool has_dashpot = false, uses_velocity = false, uses_mass = true, uses_radius = false;
    static constexpr bool weighs_onset = false;
    static constexpr int kPieces = static_cast<int>(kTablePoints) - 1;

    template <class R>
    struct Parameters {
        R loading;                                        // N/m, K1
        R restitution;                                    // restitution of the slowest impacts
        R from[kPieces], width[kPieces], slope[kPieces];  // m/s, m/s, s/m; unused pieces have no slope

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(loading), visit(restitution);
            for (int k = 0; k < kPieces; ++k) visit(from[k]), visit(width[k]), visit(slope[k]);
        }
    };
    // A contact without a table keeps its constant restitution.
    static Parameters<double> from(const PairPlan& plan) {
        Parameters<double> p{};
        p.loading = plan.loading_stiffness;
        p.restitution = std::sqrt(plan.loading_stiffness / plan.unloading_stiffness);
        const auto& table = plan.restitution_table;
        if (table.empty()) return p;
        p.restitution = table.front().restitution;
        for (std::size_t k = 1; k < table.size(); ++k) {
            p.from[k - 1] = table[k - 1].speed;
            p.width[k - 1] = table[k].speed - table[k - 1].speed;
            p.slope[k - 1] = (table[k].restitution - table[k - 1].restitution) / p.width[k - 1];
        }
        return p;
    }

    template <class R>
    using History = WaltonBraun::History<R>;

    // Unloading slope K2 (N/m).
    template <class R>
    static HWY_INLINE R unloading(const Parameters<R>& p, const History<R>& h, const Touch<R>& touch) {
        const R speed = h.largest_overlap * root(p.loading / touch.effective_mass);
        R e = p.restitution;
        for (int k = 0; k < kPieces; ++k)
            e += p.slope[k] * larger(R(0), smaller(p.width[k], speed - p.from[k]));
        return p.loading / (e * e);
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
