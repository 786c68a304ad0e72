// Turns a law into a LawKernel: the functions over a chunk of contacts that the step loop and observers call.
#if defined(GRAINREEL_LAWS_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_KERNEL_INL
#undef GRAINREEL_LAWS_KERNEL_INL
#else
#define GRAINREEL_LAWS_KERNEL_INL
#endif

#include "engine/laws/chunk-inl.hpp"
#include "engine/laws/contact_law-inl.hpp"
#include "engine/vector/twice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Runs a law over a chunk of contacts, as many at once as a register holds. It reads the chunk's rows
// (law_kernel.hpp) and the histories, and writes the force and the new history of each contact. With
// `one_kind`, all contacts have the parameters of the first.
template <class Law, class L, bool one_kind>
void step_chunk(const LawInput& in, void* histories, ForceChunk& out) {
    using Number = NumberOf<L>;
    auto* history = static_cast<Number*>(histories);
    typename Law::template Parameters<L> p;
    if constexpr (one_kind)
        p.each(SameParameters<L>(*in.parameters, in.parameters->kinds == 1 ? 0 : in.kind[0]));
    const L step(in.step), ahead(in.ahead);
    for (int c = 0; c < in.count; c += L::count) {
        in.touch->fetch_some();
        Number* kept = history + place_in_history(c, in.history_stride);
        if (!in.touch->any_touching(c, L::count)) {
            put_nothing<Law, L>(c, out);
            for (int k = 0; k < in.history_stride; ++k) store(L(0.0), kept + k * kBlock);
            continue;
        }
        const auto touching = touching_at<L, Number>(in, c);
        if constexpr (!one_kind) p = parameters_at<Law, L>(in, c);
        typename Law::template History<L> h;
        h.each(LoadHistory<L>(kept));
        const auto force = Law::force(p, h, touch_at<Law, L, Number>(in, c),
                                      velocity_at<Law, L, Number>(in, c), step, ahead);
        h.each(StoreHistory<L>(touching, kept));
        put_force<Law, L, Number>(touching, force, c, out);
    }
}

template <class L>
HWY_INLINE void put_energies(typename L::Mask touching, const ContactEnergies<L>& e, int c,
                             EnergyChunk& out) {
    store_as(select(touching, e.stored, L(0.0)), out.stored + c);
    store_as(select(touching, e.sideways, L(0.0)), out.sideways + c);
    store_as(select(touching, e.latched, L(0.0)), out.latched + c);
    store_as(select(touching, e.damping, L(0.0)), out.damping + c);
    store_as(select(touching, e.rubbing, L(0.0)), out.rubbing + c);
}

template <class Law, class L>
void observe_chunk(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy) {
    const auto* numbers = static_cast<const NumberOf<L>*>(history);
    for (int c = 0; c < in.count; c += L::count) {
        const auto touching = touching_at<L, double>(in, c);
        typename Law::template History<L> h;
        h.each(LoadHistory<L>(numbers + place_in_history(c, in.history_stride)));
        ContactEnergies<L> e;
        const auto force = Law::now(parameters_at<Law, L>(in, c), h, touch_at<Law, L, double>(in, c),
                                    velocity_at<Law, L, double>(in, c), e);
        put_force<Law, L, double>(touching, force, c, out);
        put_energies(touching, e, c, energy);
    }
}

struct CountNumbers {
    std::vector<bool>& turns;
    void operator()(double&) const { turns.push_back(false); }
    void turning(Triple<double>&) const { turns.insert(turns.end(), 3, true); }
};

struct AppendNumbers {
    std::vector<double>& values;
    void operator()(double& x) const { values.push_back(x); }
};

template <class Law>
LawParameters parameters_of(const std::vector<PairPlan>& plans) {
    std::vector<double> by_kind;
    for (const PairPlan& plan : plans) {
        auto of_kind = Law::from(plan);
        of_kind.each(AppendNumbers{by_kind});
    }
    LawParameters table;
    table.kinds = static_cast<int>(plans.size());
    const std::size_t numbers = by_kind.size() / plans.size();
    for (std::size_t p = 0; p < numbers; ++p) {
        for (std::size_t k = 0; k < plans.size(); ++k) table.add(by_kind[k * numbers + p]);
    }
    return table;
}

template <class Law, class L>
const LawKernel& kernel_of() {
    // Twice<L> takes two registers of contacts through the law side by side. That needs as many registers as
    // AVX-512 has. (With floats it was no faster than L.)
    using Most = std::conditional_t<kLanes == 8 && L::count == 8, Twice<L>, L>;
    static const LawKernel kernel = [] {
        LawKernel k;
        typename Law::template History<double> history{};
        history.each(CountNumbers{k.turns});
        k.history_size = static_cast<int>(k.turns.size());
        k.number_size = sizeof(NumberOf<L>);
        k.rubs = Law::rubs;
        k.rolls = false;
        k.uses_velocity = Law::uses_velocity;
        k.uses_mass = Law::uses_mass;
        k.uses_radius = Law::uses_radius;
        k.parameters = parameters_of<Law>;
        k.step = step_chunk<Law, L, false>;
        k.step_one_kind = step_chunk<Law, Most, true>;
        k.observe = observe_chunk<Law, L>;
        return k;
    }();
    return kernel;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
