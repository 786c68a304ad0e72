// Normal force: Walton and Braun's latching spring with a restitution that falls with speed (Walton & Braun
// 1986, J. Rheol. 30, 949). As walton_braun-inl.hpp, but the unloading slope grows with the largest force:
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
        R unloading;  // N/m, K2 of a contact that was hardly touched
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

    // N/m, K2.
    template <class R>
    static HWY_INLINE R unloading(const Parameters<R>& p, const History<R>& h, const Touch<R>&) {
        return p.unloading + p.hardening * h.largest_overlap;
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
