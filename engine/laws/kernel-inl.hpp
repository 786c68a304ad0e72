// Runs a law over a chunk of contacts, as many at once as a register holds.
#if defined(GRAINREEL_LAWS_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_KERNEL_INL
#undef GRAINREEL_LAWS_KERNEL_INL
#else
#define GRAINREEL_LAWS_KERNEL_INL
#endif

#include "engine/laws/law_kernel.hpp"
#include "engine/laws/touch-inl.hpp"

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

struct LoadHistory : Visitor<LoadHistory> {
    mutable const double* at;
    explicit LoadHistory(const double* from) : at(from) {}
    HWY_INLINE void operator()(Lanes& x) const { x = load(at), at += kBlock; }
};

struct StoreHistory : Visitor<StoreHistory> {
    LanesMask kept;
    mutable double* at;
    StoreHistory(LanesMask which, double* to) : kept(which), at(to) {}
    HWY_INLINE void operator()(Lanes& x) const { store(select(kept, x, Lanes(0.0)), at), at += kBlock; }
};

struct SameParameters : Visitor<SameParameters> {
    mutable const double* at;
    explicit SameParameters(const double* from) : at(from) {}
    HWY_INLINE void operator()(Lanes& x) const { x = Lanes(*at++); }
};

struct ParametersOfKind : Visitor<ParametersOfKind> {
    using Indices = hn::RebindToSigned<Doubles>;
    hn::Vec<Indices> kind;
    std::ptrdiff_t kinds;
    mutable const double* at;
    ParametersOfKind(const LawParameters& p, const std::int32_t* kind_of)
        : kind(hn::PromoteTo(Indices(), hn::LoadU(hn::Rebind<std::int32_t, Doubles>(), kind_of))),
          kinds(p.kinds),
          at(p.values.data()) {}
    HWY_INLINE void operator()(Lanes& x) const {
        x = Lanes(hn::GatherIndex(Doubles(), at, kind));
        at += kinds;
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

template <class Law>
HWY_INLINE typename Law::template Parameters<Lanes> parameters_at(const LawInput& in, int c) {
    typename Law::template Parameters<Lanes> p;
    p.each(ParametersOfKind(*in.parameters, in.kind + c));
    return p;
}

template <class Law>
HWY_INLINE Touch<Lanes> touch_at(const LawInput& in, int c) {
    const TouchChunk& chunk = *in.touch;
    Touch<Lanes> t;
    t.normal = {load(chunk.normal[0] + c), load(chunk.normal[1] + c), load(chunk.normal[2] + c)};
    t.overlap = load(chunk.overlap + c);
    t.twist = Lanes(0.0);
    if constexpr (Law::rubs) t.twist = load(chunk.twist + c);
    t.effective_mass = t.effective_radius = Lanes(0.0);
    if constexpr (Law::uses_mass) t.effective_mass = load(in.effective_mass + c);
    if constexpr (Law::uses_radius) t.effective_radius = load(in.effective_radius + c);
    t.closing_speed = t.step = Lanes(0.0);
    t.slip = t.slip_velocity = {Lanes(0.0), Lanes(0.0), Lanes(0.0)};
    return t;
}

template <class Law>
HWY_INLINE Triple<Lanes> velocity_at(const LawInput& in, int c) {
    if constexpr (Law::rubs || Law::uses_velocity) {
        const auto& v = in.touch->velocity;
        return {load(v[0] + c), load(v[1] + c), load(v[2] + c)};
    } else {
        return {Lanes(0.0), Lanes(0.0), Lanes(0.0)};
    }
}

template <class Law, class Force>
HWY_INLINE void put_force(LanesMask touching, const Force& f, int c, ForceChunk& out) {
    store(select(touching, f.normal, Lanes(0.0)), out.normal + c);
    if constexpr (Law::rubs) {
        store(select(touching, f.tangential.x, Lanes(0.0)), out.tangential[0] + c);
        store(select(touching, f.tangential.y, Lanes(0.0)), out.tangential[1] + c);
        store(select(touching, f.tangential.z, Lanes(0.0)), out.tangential[2] + c);
    }
}

template <class Law>
HWY_INLINE void put_nothing(int c, ForceChunk& out) {
    store(Lanes(0.0), out.normal + c);
    if constexpr (Law::rubs) {
        for (auto& axis : out.tangential) store(Lanes(0.0), axis + c);
    }
}

template <class Law>
const LawKernel& kernel_of();

template <class Law, bool one_kind>
void step_chunk(const LawInput& in, double* history, ForceChunk& out) {
    const std::size_t size = kernel_of<Law>().history_size, stride = in.history_stride;
    typename Law::template Parameters<Lanes> p;
    if constexpr (one_kind) p.each(SameParameters(in.parameters->values.data()));
    const Lanes step(in.step), ahead(in.ahead);
    for (int c = 0; c < in.count; c += kLanes) {
        double* kept = history + (c / kBlock) * (stride * kBlock) + c % kBlock;
        if (!in.touch->any_touching(c, kLanes)) {
            put_nothing<Law>(c, out);
            for (std::size_t k = 0; k < size; ++k) store(Lanes(0.0), kept + k * kBlock);
            continue;
        }
        const LanesMask touching = load(in.touch->overlap + c) > Lanes(0.0);
        if constexpr (!one_kind) p = parameters_at<Law>(in, c);
        typename Law::template History<Lanes> h;
        h.each(LoadHistory(kept));
        const auto force = Law::force(p, h, touch_at<Law>(in, c), velocity_at<Law>(in, c), step, ahead);
        h.each(StoreHistory(touching, kept));
        put_force<Law>(touching, force, c, out);
    }
}

template <class Law>
void step_any(const LawInput& in, double* history, ForceChunk& out) {
    in.parameters->kinds == 1 ? step_chunk<Law, true>(in, history, out)
                              : step_chunk<Law, false>(in, history, out);
}

HWY_INLINE void put_energies(LanesMask touching, const Energies<Lanes>& e, int c, EnergyChunk& out) {
    store(select(touching, e.stored, Lanes(0.0)), out.stored + c);
    store(select(touching, e.sideways, Lanes(0.0)), out.sideways + c);
    store(select(touching, e.latched, Lanes(0.0)), out.latched + c);
    store(select(touching, e.damping, Lanes(0.0)), out.damping + c);
    store(select(touching, e.rubbing, Lanes(0.0)), out.rubbing + c);
}

template <class Law>
void observe_chunk(const LawInput& in, const double* history, ForceChunk& out, EnergyChunk& energy) {
    const std::size_t stride = in.history_stride;
    for (int c = 0; c < in.count; c += kLanes) {
        const LanesMask touching = load(in.touch->overlap + c) > Lanes(0.0);
        typename Law::template History<Lanes> h;
        h.each(LoadHistory(history + (c / kBlock) * (stride * kBlock) + c % kBlock));
        Energies<Lanes> e;
        const auto force =
            Law::now(parameters_at<Law>(in, c), h, touch_at<Law>(in, c), velocity_at<Law>(in, c), e);
        put_force<Law>(touching, force, c, out);
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
        for (std::size_t k = 0; k < plans.size(); ++k) table.values.push_back(by_kind[k * numbers + p]);
    }
    return table;
}

template <class Law>
const LawKernel& kernel_of() {
    static const LawKernel kernel = [] {
        LawKernel k;
        typename Law::template History<double> history{};
        history.each(CountNumbers{k.turns});
        k.history_size = static_cast<int>(k.turns.size());
        k.rubs = Law::rubs;
        k.rolls = false;
        k.uses_velocity = Law::uses_velocity;
        k.uses_mass = Law::uses_mass;
        k.uses_radius = Law::uses_radius;
        k.parameters = parameters_of<Law>;
        k.step = step_any<Law>;
        k.observe = observe_chunk<Law>;
        return k;
    }();
    return kernel;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
