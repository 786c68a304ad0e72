// Calls a contact law of the library's user for each contact, where the program would run a law of its own.
#include "engine/library/internal.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace grainreel::v1 {
namespace {

constexpr int most_numbers = 16, most_vectors = 4;

// The numbers of a kind of contact in LawParameters; parameters_of() lists them in this order. The law's
// address stands there in two halves, because a double holds each of them exactly. A kernel finds its law
// only by this address.
enum Parameter { address_high, address_low, stiffness, restitution, friction, parameters };

// Where the first number of a contact is in the history; the program's own laws use the same layout.
std::size_t place_in_history(int c, int stride) {
    return static_cast<std::size_t>(c / kBlock) * static_cast<std::size_t>(stride * kBlock) +
           static_cast<std::size_t>(c % kBlock);
}

Vec3 vector_at(const Row* rows, int c) {
    return {rows[0][c], rows[1][c], rows[2][c]};
}

// Turns a vector along with its contact as the program's laws do (engine/laws/friction-inl.hpp): rotates it
// by Cayley's rotation and then removes its part along the normal.
Vec3 carried(const Vec3& vector, const Vec3& turn, const Vec3& normal) {
    const Vec3 once = turn.cross(vector), twice = turn.cross(once);
    const Vec3 turned = vector + (once + twice) * (2 / (1 + turn.squaredNorm()));
    return turned - normal * normal.dot(turned);
}

// The memory of one contact, taken from a block of the history and put back. `before` is the relative
// velocity in the last step. It is kept for the extrapolation, and the law does not see it.
struct Memory {
    std::array<double, most_numbers> numbers{};
    std::array<Vector, most_vectors> vectors{};
    Vec3 before{0, 0, 0};

    ContactMemory shown(int n, int v) {
        return {std::span(numbers.data(), static_cast<std::size_t>(n)),
                std::span(vectors.data(), static_cast<std::size_t>(v))};
    }
    // Calls a function with all numbers in the order of the history. kernel_.turns is in the same order.
    template <class Visit>
    void each(int n, int v, const Visit& visit) {
        for (int k = 0; k < n; ++k) visit(numbers[k]);
        for (int k = 0; k < v; ++k) {
            Vector& vector = vectors[k];
            visit(vector.x), visit(vector.y), visit(vector.z);
        }
        for (int k = 0; k < 3; ++k) visit(before[k]);
    }
    void load(const double* at, int n, int v) {
        each(n, v, [&](double& x) { x = *at, at += kBlock; });
    }
    void store(double* at, int n, int v) {
        each(n, v, [&](double& x) { *at = x, at += kBlock; });
    }
    void carry(int v, const Vec3& turn, const Vec3& normal) {
        for (int k = 0; k < v; ++k) {
            Vector& vector = vectors[k];
            vector = outside(carried(inside(vector), turn, normal));
        }
    }
};

Touch touch_of(const LawInput& in, int c, int kind) {
    const TouchChunk& chunk = *in.touch;
    const double* numbers = in.parameters->values.data() + kind;
    const auto number = [&](Parameter p) { return numbers[static_cast<int>(p) * in.parameters->kinds]; };
    Touch touch;
    touch.overlap = chunk.overlap[c];
    touch.normal = outside(vector_at(chunk.normal, c));
    touch.effective_mass = 1 / chunk.inverse_mass[c];
    touch.effective_radius = chunk.effective_radius[c];
    touch.stiffness = number(stiffness);
    touch.restitution = number(restitution);
    touch.friction = number(friction);
    return touch;
}

void set_velocity(Touch& touch, const Vec3& velocity) {
    const Vec3 normal = inside(touch.normal);
    touch.closing_speed = normal.dot(velocity);
    touch.slip_velocity = outside(Vec3(velocity - normal * touch.closing_speed));
}

void put(const ContactForce& force, int c, ForceChunk& out) {
    out.normal.doubles[c] = force.normal;
    out.tangential[0].doubles[c] = force.tangential.x;
    out.tangential[1].doubles[c] = force.tangential.y;
    out.tangential[2].doubles[c] = force.tangential.z;
}

int kind_of(const LawInput& in, int c, bool one_kind) {
    if (in.parameters->kinds == 1) return 0;
    return in.kind[one_kind ? 0 : c];
}

}  // namespace

OwnLaw::OwnLaw(std::shared_ptr<const ContactLaw> law, std::string name)
    : law_(std::move(law)), name_(std::move(name)), kernel_{} {
    if (!law_) throw Error(fmt::format("{} is null", name_));
    numbers_ = law_->numbers();
    vectors_ = law_->vectors();
    if (numbers_ < 0 || numbers_ > most_numbers || vectors_ < 0 || vectors_ > most_vectors)
        throw Error(
            fmt::format("{} keeps {} numbers and {} vectors; it may keep from 0 to {} and from 0 to {}",
                        name_, numbers_, vectors_, most_numbers, most_vectors));
    kernel_.turns.assign(static_cast<std::size_t>(numbers_), false);
    kernel_.turns.resize(static_cast<std::size_t>(numbers_ + 3 * vectors_ + 3), true);
    kernel_.history_size = static_cast<int>(kernel_.turns.size());
    kernel_.number_size = sizeof(double);
    kernel_.rubs = kernel_.uses_velocity = kernel_.uses_mass = kernel_.uses_radius = true;
    kernel_.parameters = parameters_of;
    kernel_.step = step;
    kernel_.step_one_kind = step_one_kind;
    kernel_.observe = observe;
    kernel_.own = this;
}

LawParameters OwnLaw::parameters_of(const std::vector<PairPlan>& kinds) {
    LawParameters table;
    table.kinds = static_cast<int>(kinds.size());
    const auto* kernel = static_cast<const Kernel*>(kinds.front().model.own);
    const auto address = reinterpret_cast<std::uintptr_t>(kernel->own);
    for (int p = 0; p < parameters; ++p) {
        for (const PairPlan& kind : kinds) {
            const double values[parameters] = {static_cast<double>(address >> 32),
                                               static_cast<double>(address & 0xffffffffU),
                                               kind.loading_stiffness, kind.restitution, kind.friction};
            table.add(values[p]);
        }
    }
    return table;
}

OwnLaw& OwnLaw::of(const LawParameters& table) {
    const auto half = [&](Parameter p) { return static_cast<std::uintptr_t>(table.values[p * table.kinds]); };
    return *reinterpret_cast<OwnLaw*>(half(address_high) << 32 | half(address_low));
}

void OwnLaw::step_kinds(const LawInput& in, double* history, ForceChunk& out, bool one_kind) {
    OwnLaw& own = of(*in.parameters);
    for (int c = 0; c < in.count; ++c) {
        double* kept = history + place_in_history(c, in.history_stride);
        put({}, c, out);
        if (!in.touch->touches(c)) {
            for (int k = 0; k < own.kernel_.history_size; ++k) kept[k * kBlock] = 0;
            continue;
        }
        Touch touch = touch_of(in, c, kind_of(in, c, one_kind));
        Memory memory;
        memory.load(kept, own.numbers_, own.vectors_);
        const Vec3 velocity = vector_at(in.touch->velocity, c), normal = inside(touch.normal);
        // The velocity is extrapolated by its change since the last step. A new contact has no last step, so
        // its velocity is taken as it is.
        const bool known = !memory.before.isZero(0);
        set_velocity(touch, known ? Vec3(velocity + (velocity - memory.before) * in.ahead) : velocity);
        touch.slip = outside(Vec3((velocity - normal * normal.dot(velocity)) * in.step));
        touch.step = in.step;
        memory.before = velocity;
        memory.carry(own.vectors_, vector_at(in.touch->turn, c), normal);
        try {
            const ContactForce force = own.law_->force(touch, memory.shown(own.numbers_, own.vectors_));
            own.check(force, touch);
            put(force, c, out);
        } catch (...) {
            own.note(std::current_exception());
        }
        memory.store(kept, own.numbers_, own.vectors_);
    }
}

void OwnLaw::step(const LawInput& in, void* history, ForceChunk& out) {
    step_kinds(in, static_cast<double*>(history), out, false);
}
void OwnLaw::step_one_kind(const LawInput& in, void* history, ForceChunk& out) {
    step_kinds(in, static_cast<double*>(history), out, true);
}

void OwnLaw::observe(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy) {
    OwnLaw& own = of(*in.parameters);
    for (int c = 0; c < in.count; ++c) {
        put({}, c, out);
        for (double* row : {energy.stored, energy.sideways, energy.latched, energy.damping, energy.rubbing})
            row[c] = 0;
        if (!in.touch->touches(c)) continue;
        Touch touch = touch_of(in, c, kind_of(in, c, false));
        set_velocity(touch, vector_at(in.touch->velocity, c));
        Memory memory, copy;
        memory.load(static_cast<const double*>(history) + place_in_history(c, in.history_stride),
                    own.numbers_, own.vectors_);
        copy = memory;
        try {
            const ContactForce force = own.law_->force(touch, memory.shown(own.numbers_, own.vectors_));
            own.check(force, touch);
            put(force, c, out);
            energy.stored[c] = own.law_->stored_energy(touch, copy.shown(own.numbers_, own.vectors_));
            energy.rubbing[c] = inside(force.tangential).dot(inside(touch.slip_velocity));
        } catch (...) {
            own.note(std::current_exception());
        }
    }
}

void OwnLaw::check(const ContactForce& force, const Touch& touch) const {
    if (std::isfinite(force.normal) && inside(force.tangential).allFinite()) return;
    throw Error(
        fmt::format(
            "{} returned a force that is no number: normal {} N, tangential ({}, {}, {}) N, for an overlap "
            "of {:.3g} m and a closing speed of {:.3g} m/s; mend its force()",
            name_, force.normal, force.tangential.x, force.tangential.y, force.tangential.z, touch.overlap,
            touch.closing_speed),
        Error::Kind::failure);
}

void OwnLaw::note(std::exception_ptr thrown) {
    const std::scoped_lock lock(guard_);
    if (!thrown_) thrown_ = std::move(thrown);
}

void OwnLaw::rethrow() {
    std::exception_ptr thrown;
    {
        const std::scoped_lock lock(guard_);
        thrown = std::exchange(thrown_, nullptr);
    }
    if (thrown) std::rethrow_exception(thrown);
}

}  // namespace grainreel::v1
