// Runs a law over a chunk of contacts, as many at once as a register holds.
#if defined(GRAINREEL_LAWS_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_KERNEL_INL
#undef GRAINREEL_LAWS_KERNEL_INL
#else
#define GRAINREEL_LAWS_KERNEL_INL
#endif

#include "engine/laws/law_kernel.hpp"
#include "engine/laws/row-inl.hpp"
#include "engine/laws/touch-inl.hpp"
#include "engine/vector/twice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Visitors for the each() of histories and parameters; a `turning` triple changes sign with the order of the
// bodies.
template <class Visit>
struct Visitor {
    template <class R>
    HWY_INLINE void turning(Triple<R>& t) const {
        const Visit& visit = *static_cast<const Visit*>(this);
        visit(t.x), visit(t.y), visit(t.z);
    }
};

template <class L>
struct LoadHistory : Visitor<LoadHistory<L>> {
    mutable const NumberOf<L>* at;
    explicit LoadHistory(const NumberOf<L>* from) : at(from) {}
    HWY_INLINE void operator()(L& x) const { x = load<L>(at), at += kBlock; }
};

template <class L>
struct StoreHistory : Visitor<StoreHistory<L>> {
    typename L::Mask kept;
    mutable NumberOf<L>* at;
    StoreHistory(typename L::Mask which, NumberOf<L>* to) : kept(which), at(to) {}
    HWY_INLINE void operator()(L& x) const { store(select(kept, x, L(0.0)), at), at += kBlock; }
};

template <class L>
struct SameParameters : Visitor<SameParameters<L>> {
    std::ptrdiff_t kinds;
    mutable const NumberOf<L>* at;
    SameParameters(const LawParameters& p, std::int32_t kind)
        : kinds(p.kinds), at(p.numbers<NumberOf<L>>() + kind) {}
    HWY_INLINE void operator()(L& x) const { x = L(static_cast<double>(*at)), at += kinds; }
};

template <class L>
struct ParametersOfKind : Visitor<ParametersOfKind<L>> {
    using Tag = typename L::Tag;
    using Indices = hn::RebindToSigned<Tag>;
    hn::Vec<Indices> kind;
    std::ptrdiff_t kinds;
    mutable const NumberOf<L>* at;
    ParametersOfKind(const LawParameters& p, const std::int32_t* kind_of)
        : kind(indices(kind_of)), kinds(p.kinds), at(p.numbers<NumberOf<L>>()) {}
    HWY_INLINE void operator()(L& x) const {
        x = L(hn::GatherIndex(Tag(), at, kind));
        at += kinds;
    }
    static HWY_INLINE hn::Vec<Indices> indices(const std::int32_t* kind_of) {
        if constexpr (sizeof(NumberOf<L>) == sizeof(std::int32_t))
            return hn::LoadU(Indices(), kind_of);
        else
            return hn::PromoteTo(Indices(), hn::LoadU(hn::Rebind<std::int32_t, Tag>(), kind_of));
    }
};

struct CountNumbers {
    std::vector<bool>& turns;
    void operator()(double&) const { turns.push_back(false); }
    void turning(Triple<double>&) const { turns.insert(turns.end(), 3, true); }
};

struct AppendNumbers {
    std::vector<double>& values;
    void operator()(double& x) const { values.push_back(x); }
};

template <class Law, class L>
HWY_INLINE typename Law::template Parameters<L> parameters_at(const LawInput& in, int c) {
    typename Law::template Parameters<L> p;
    p.each(ParametersOfKind<L>(*in.parameters, in.kind + c));
    return p;
}

template <class Number, class L>
HWY_INLINE void put_where(typename L::Mask which, L value, Row& to, int c) {
    put<Number>(select(which, value, L(0.0)), to, c);
}
template <class Number, class L>
HWY_INLINE void put_where(typename L::Mask which, const Triple<L>& t, Row* to, int c) {
    put<Number>(select(which, t, Triple<L>{L(0.0), L(0.0), L(0.0)}), to, c);
}

template <class L, class Number>
HWY_INLINE typename L::Mask touching_at(const LawInput& in, int c) {
    return row_at<L, Number>(in.touch->overlap, c) > L(0.0);
}

template <class Law, class L, class Number>
HWY_INLINE Touch<L> touch_at(const LawInput& in, int c) {
    const TouchChunk& chunk = *in.touch;
    Touch<L> t;
    t.normal = triple_at<L, Number>(chunk.normal, c);
    t.overlap = row_at<L, Number>(chunk.overlap, c);
    t.turn = {L(0.0), L(0.0), L(0.0)};
    if constexpr (Law::rubs) t.turn = triple_at<L, Number>(chunk.turn, c);
    t.inverse_mass = t.effective_mass = t.effective_radius = L(0.0);
    if constexpr (Law::uses_mass) {
        t.inverse_mass = row_at<L, Number>(chunk.inverse_mass, c);
        t.effective_mass = L(1.0) / t.inverse_mass;
    }
    if constexpr (Law::uses_radius) t.effective_radius = row_at<L, Number>(chunk.effective_radius, c);
    t.closing_speed = t.step = L(0.0);
    t.slip = t.slip_velocity = {L(0.0), L(0.0), L(0.0)};
    return t;
}

template <class Law, class L, class Number>
HWY_INLINE Triple<L> velocity_at(const LawInput& in, int c) {
    if constexpr (Law::rubs || Law::uses_velocity) {
        return triple_at<L, Number>(in.touch->velocity, c);
    } else {
        return {L(0.0), L(0.0), L(0.0)};
    }
}

template <class Law, class L, class Number, class Force>
HWY_INLINE void put_force(typename L::Mask touching, const Force& f, int c, ForceChunk& out) {
    put_where<Number>(touching, f.normal, out.normal, c);
    if constexpr (Law::rubs) put_where<Number>(touching, f.tangential, out.tangential, c);
}

template <class Law, class L>
HWY_INLINE void put_nothing(int c, ForceChunk& out) {
    store(L(0.0), out.normal.of<NumberOf<L>>() + c);
    if constexpr (Law::rubs) {
        for (Row& axis : out.tangential) store(L(0.0), axis.of<NumberOf<L>>() + c);
    }
}

// Where the first number of contact c stands in a history of `stride` numbers a contact.
HWY_INLINE std::size_t place_in_history(int c, std::size_t stride) {
    return (c / kBlock) * (stride * kBlock) + c % kBlock;
}

template <class Law, class L, bool one_kind>
void step_chunk(const LawInput& in, NumberOf<L>* history, ForceChunk& out) {
    using Number = NumberOf<L>;
    typename Law::template Parameters<L> p;
    if constexpr (one_kind)
        p.each(SameParameters<L>(*in.parameters, in.parameters->kinds == 1 ? 0 : in.kind[0]));
    const L step(in.step), ahead(in.ahead);
    for (int c = 0; c < in.count; c += L::count) {
        in.touch->fetch_some();
        NumberOf<L>* kept = history + place_in_history(c, in.history_stride);
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

HWY_INLINE bool of_one_kind(const LawInput& in) {
    std::int32_t others = 0;
    for (int c = 0; c < in.count; ++c) others |= in.kind[c] ^ in.kind[0];
    return others == 0;
}

template <class Law, class L>
void step_any(const LawInput& in, void* history, ForceChunk& out) {
    auto* numbers = static_cast<NumberOf<L>*>(history);
    // There must be registers for two: AVX-512 has. (With floats two were no faster than one.)
    using Most = std::conditional_t<kLanes == 8 && L::count == 8, Twice<L>, L>;
    // (A large grain among small ones: nearly all chunks are of one kind, and take a tenth less time so.)
    in.parameters->kinds == 1 || of_one_kind(in) ? step_chunk<Law, Most, true>(in, numbers, out)
                                                 : step_chunk<Law, L, false>(in, numbers, out);
}

template <class L>
HWY_INLINE void put_energies(typename L::Mask touching, const Energies<L>& e, int c, EnergyChunk& out) {
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
        Energies<L> e;
        const auto force = Law::now(parameters_at<Law, L>(in, c), h, touch_at<Law, L, double>(in, c),
                                    velocity_at<Law, L, double>(in, c), e);
        put_force<Law, L, double>(touching, force, c, out);
        put_energies(touching, e, c, energy);
    }
}

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
        k.step = step_any<Law, L>;
        k.observe = observe_chunk<Law, L>;
        return k;
    }();
    return kernel;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
