// Normal force: Walton and Braun's latching spring with a restitution from a table e(v). As
// walton_braun-inl.hpp, but K2 = K1 / e(v)^2 with the speed v = a_max sqrt(K1 / m_eff) of a free impact that
// reaches the largest overlap so far. Straight lines between the rows, constant beyond.
#if defined(GRAINREEL_LAWS_WALTON_BRAUN_TABLE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_WALTON_BRAUN_TABLE_INL
#undef GRAINREEL_LAWS_WALTON_BRAUN_TABLE_INL
#else
#define GRAINREEL_LAWS_WALTON_BRAUN_TABLE_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct WaltonBraunTable : HardeningSpring<WaltonBraunTable> {
    static constexpr bool has_dashpot = false, uses_velocity = false, uses_mass = true, uses_radius = false;
    static constexpr bool weighs_onset = false;
    static constexpr int kPieces = static_cast<int>(kTablePoints) - 1;

    template <class R>
    struct Parameters {
        R loading;                                        // N/m, K1
        R restitution;                                    // of the slowest impacts
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

    // N/m, K2.
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
