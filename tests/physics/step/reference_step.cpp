// The plain step against which the fast one is tested. It must share no code with engine/step and
// engine/laws.
#include "tests/physics/step/reference_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainreel {
namespace {

Vec3 across(const Vec3& v, const Vec3& k) {
    return v - k * k.dot(v);
}

Vec3 capped(const Vec3& force, double limit) {
    return force.norm() > limit ? Vec3(force * (limit / force.norm())) : force;
}

// Cayley's rotation of t by q = tan(angle / 2) along the axis.
Vec3 turned(const Vec3& t, const Vec3& q, const Vec3& k) {
    return across(t + 2 / (1 + q.squaredNorm()) * (q.cross(t) + q.cross(q.cross(t))), k);
}

}  // namespace

ReferenceStep::ReferenceStep(const Plan& plan, std::vector<Face> faces, const Vec3& gravity,
                             ReferenceShaking shaking, std::vector<ReferenceGrain> grains)
    : plan_(plan),
      faces_(std::move(faces)),
      gravity_(gravity),
      shaking_(shaking),
      dt_(plan.clock.step),
      grains_(std::move(grains)) {}

void ReferenceStep::run(std::int64_t steps) {
    const auto kick = [&] {
        for (ReferenceGrain& g : grains_) {
            g.velocity += 0.5 * dt_ * (g.force / g.mass + gravity_);
            g.spin += 0.5 * dt_ * g.torque / (0.4 * g.mass * g.radius * g.radius);
        }
    };
    for (const std::int64_t end = step_ + steps; step_ < end;) {
        kick();
        for (ReferenceGrain& g : grains_) {
            g.position += dt_ * g.velocity;
            g.force.setZero();
            g.torque.setZero();
        }
        ++step_;
        for (std::size_t i = 0; i < grains_.size(); ++i) {
            for (std::size_t f = 0; f < faces_.size(); ++f) meet_wall(i, f);
            for (std::size_t j = i + 1; j < grains_.size(); ++j) meet_grain(i, j);
        }
        kick();
    }
}

void ReferenceStep::meet_grain(std::size_t i, std::size_t j) {
    ReferenceGrain &a = grains_[i], &b = grains_[j];
    const double d = (b.position - a.position).norm(), overlap = a.radius + b.radius - d;
    const std::pair<std::size_t, std::int64_t> key{i, static_cast<std::int64_t>(j)};
    if (overlap <= 0) {
        memory_.erase(key);
        return;
    }
    const PairPlan& p = plan_.between(a.species, b.species);
    Meeting c;
    c.k = (b.position - a.position) / d;
    c.overlap = overlap;
    c.mass = a.mass * b.mass / (a.mass + b.mass);
    c.radius = a.radius * b.radius / (a.radius + b.radius);
    const double first_arm = 0.5 * (d + (a.radius * a.radius - b.radius * b.radius) / d);
    const double second_arm = d - first_arm;
    // The velocities are those of the step's middle, where the normal was k + change.
    const Vec3 centres = a.velocity - b.velocity, sideways = across(centres, c.k);
    const Vec3 change = sideways * dt_ / (2 * d);
    c.velocity = centres;
    if (p.model.tangential != TangentialLaw::none) {
        c.velocity -= change * c.k.dot(centres);
        c.velocity += (a.spin * first_arm + b.spin * second_arm).cross(c.k + change);
    }
    const Vec3 back =
        change * (1 - c.k.dot(centres) * dt_ / d);  // d was larger by the distance that they have closed
    c.turn = back.cross(c.k) + 0.25 * dt_ * (a.spin + b.spin).dot(c.k) * (c.k + back);
    c.rolled = across(a.spin - b.spin, c.k) * dt_;
    met_ += memory_.count(key) == 0;
    const Push f = push(p, memory_[key], c);
    const Vec3 force = c.k * f.normal + f.tangential, turning = c.k.cross(f.tangential);
    a.force -= force, b.force += force;
    a.torque -= first_arm * turning + f.rolling;
    b.torque -= second_arm * turning - f.rolling;
}

Vec3 ReferenceStep::displacement(const Face& face, std::int64_t step) const {
    const double turns = shaking_.frequency * dt_ * static_cast<double>(step);
    const double away = shaking_.amplitude * std::sin(2 * std::numbers::pi * turns);
    return face.body.driven ? Vec3(away * shaking_.direction) : Vec3(0, 0, 0);
}

void ReferenceStep::meet_wall(std::size_t i, std::size_t f) {
    ReferenceGrain& a = grains_[i];
    const Face& face = faces_[f];
    const Vec3 from = a.position - face.point - displacement(face, step_);
    const bool round = face.kind == Face::Kind::cylinder;
    const double out = std::hypot(from.x(), from.y());
    const double distance = round ? face.radius - out : face.normal.dot(from);
    const std::pair<std::size_t, std::int64_t> key{i, -1 - static_cast<std::int64_t>(f)};
    if (distance >= a.radius) {
        memory_.erase(key);
        return;
    }
    const PairPlan& p = plan_.wall[a.species];
    Meeting c;
    c.k = round ? Vec3(from.x() / out, from.y() / out, 0) : Vec3(-face.normal);
    c.overlap = a.radius - distance;
    c.mass = a.mass;
    c.radius = a.radius;
    const Vec3 wall = (displacement(face, step_) - displacement(face, step_ - 1)) / dt_;
    const Vec3 centres = a.velocity - wall;
    // The normal of a plane stands still, and that of a cylinder goes round with the grain.
    Vec3 change(0, 0, 0), back(0, 0, 0);
    if (round) {
        change = -across(centres, c.k) * dt_ / (2 * out);
        change.z() = 0;
        back = change * (1 + c.k.dot(centres) * dt_ / out);
    }
    c.velocity = centres;
    if (p.model.tangential != TangentialLaw::none) {
        c.velocity -= change * c.k.dot(centres);
        c.velocity += (a.spin * distance).cross(c.k + change);
    }
    c.turn = back.cross(c.k) + 0.25 * dt_ * a.spin.dot(c.k) * (c.k + back);
    c.rolled = across(a.spin, c.k) * dt_;
    met_ += memory_.count(key) == 0;
    const Push push_on_wall = push(p, memory_[key], c);
    a.force -= c.k * push_on_wall.normal + push_on_wall.tangential;
    a.torque -= distance * c.k.cross(push_on_wall.tangential) + push_on_wall.rolling;
}

// Dashpots need the velocity half a step later than it is known. It goes on as over the last step, except
// that the contact's own force has changed since.
ReferenceStep::Push ReferenceStep::push(const PairPlan& p, Memory& m, Meeting c) const {
    const double root = std::sqrt(c.radius * c.overlap);
    const bool hertz = p.model.normal == NormalForce::hertz;
    const Vec3 slip_velocity = c.velocity;
    double speed = c.k.dot(c.velocity), acts = 1, touched = dt_, normal = 0, sideways_damping = 0;
    Vec3 later = slip_velocity;
    if (hertz || p.model.normal == NormalForce::spring_dashpot) {
        if (m.velocity_before.squaredNorm() > 0) later += 0.5 * (c.velocity - m.velocity_before);
        m.velocity_before = c.velocity;
        const double modulus = 4.0 / 3.0 * p.modulus;
        const double spring = hertz ? modulus * root * c.overlap : p.loading_stiffness * c.overlap;
        const double damping =
            hertz ? p.hertz_damping * std::sqrt(c.mass * modulus * root) : p.normal_damping * c.mass;
        speed = (c.k.dot(later) - 0.5 * dt_ * (spring - m.force_before) / c.mass) /
                (1 + 0.5 * dt_ * damping / c.mass);
        normal = spring + damping * speed;
        if (!p.attraction) normal = std::max(0.0, normal);
        m.force_before = normal;
        sideways_damping = hertz ? std::sqrt(p.tangential_ratio) * damping : p.tangential_damping * c.mass;
    } else {
        normal = normal_force(p, m, c, speed, acts, touched);
    }
    // All slip counts from the touch. Only the linear spring acts for as long as the normal force.
    if (p.model.tangential != TangentialLaw::linear_spring) normal *= acts, acts = 1;
    Push f{normal * acts, Vec3(0, 0, 0), Vec3(0, 0, 0)};
    if (p.model.tangential == TangentialLaw::none) return f;
    m.tangential = turned(m.tangential, c.turn, c.k);
    const Vec3 slip = across(c.velocity, c.k) * touched, damping = across(later, c.k) * sideways_damping;
    if (p.model.tangential == TangentialLaw::incremental_slip) {
        f.tangential = m.tangential = slip_force(p, m, slip, normal);
    } else {
        double stiffness = p.tangential_stiffness;
        if (hertz) {
            stiffness = p.tangential_ratio * 2 * p.modulus * root;
            if (stiffness < m.stiffness) m.tangential *= stiffness / m.stiffness;
            m.stiffness = stiffness;
        }
        const Vec3 whole = capped(m.tangential + stiffness * slip + damping, p.friction * std::abs(normal));
        m.tangential = whole - damping;
        f.tangential = whole * acts;
    }
    if (!p.model.rolls) return f;
    m.rolling = turned(m.rolling, c.turn, c.k) + c.rolled * p.tangential_stiffness * c.radius * c.radius;
    f.rolling = m.rolling = capped(m.rolling, p.rolling_friction * c.radius * std::max(0.0, f.normal));
    return f;
}

// acts: share of the step in which the spring's force counts. touched: s, part of the step after the touch.
double ReferenceStep::normal_force(const PairPlan& p, Memory& m, const Meeting& c, double speed, double& acts,
                                   double& touched) const {
    if (p.model.normal == NormalForce::walton_braun_corrected)
        return corrected_force(p, m, c, speed, acts, touched);
    m.largest_overlap = std::max(m.largest_overlap, c.overlap);
    double unloading = p.unloading_stiffness;
    if (p.model.normal == NormalForce::walton_braun_speed)
        unloading = p.loading_stiffness * (1 + p.hardening * m.largest_overlap);
    if (p.model.normal == NormalForce::walton_braun_table) {
        const auto& table = p.restitution_table;
        const double v = m.largest_overlap * std::sqrt(p.loading_stiffness / c.mass);
        double e = table.front().restitution;
        for (std::size_t row = 1; row < table.size() && v > table[row - 1].speed; ++row) {
            const double share = (v - table[row - 1].speed) / (table[row].speed - table[row - 1].speed);
            e = std::lerp(table[row - 1].restitution, table[row].restitution, std::min(1.0, share));
        }
        unloading = p.loading_stiffness / (e * e);
    }
    const double residual = m.largest_overlap * (1 - p.loading_stiffness / unloading);
    return std::max(0.0, std::min(p.loading_stiffness * c.overlap, unloading * (c.overlap - residual)));
}

double ReferenceStep::corrected_force(const PairPlan& p, Memory& m, const Meeting& c, double speed,
                                      double& acts, double& touched) const {
    const double k1 = p.loading_stiffness, e2 = k1 / p.unloading_stiffness, a = c.overlap;
    if (m.largest_overlap == 0 && speed > 0) touched = std::min(dt_, a / speed);
    m.softness = e2 / k1 + (1 - e2) * dt_ * dt_ / (4 * c.mass);  // 1/K2'
    const bool loads = a > m.largest_overlap;
    m.largest_overlap = loads ? a : std::max(m.largest_overlap, m.peak);
    const double rest = a - m.largest_overlap * (1 - k1 * m.softness);  // overlap beyond the residual one
    const double spring = std::max(0.0, std::min(k1 * a, rest / m.softness));
    const double now = speed - 0.5 * spring * touched / c.mass;
    if (loads) m.peak = std::sqrt(a * a + c.mass * now * now / k1);
    double impulse = 0.5 * spring * (touched + dt_);
    if (spring > 0 && rest + dt_ * (speed - impulse / c.mass) < 0)  // it leaves within the step
        impulse =
            std::max(0.0, c.mass * (speed + std::sqrt(now * now + spring * spring * m.softness / c.mass)));
    acts = spring > 0 ? impulse / dt_ / spring : 0;
    return spring;
}

namespace {

// The y of y^(1/gamma) + b y = a: for 1 and 2 in closed form, for 1/3 by two steps of Newton's method from
// the root for b = 0, for others by one.
double softness(double a, double b, double gamma) {
    if (gamma == 1) return a / (1 + b);
    if (gamma == 2) return std::pow(2 * a / (1 + std::sqrt(1 + 4 * a * b)), 2);
    if (gamma != 1.0 / 3.0) {
        const double y = std::pow(a, gamma);
        return b > 0 ? std::min(y / (1 + gamma * b * y / a), a / b) : y;
    }
    double y = std::cbrt(a);
    for (int k = 0; k < 2; ++k) y -= (y * y * y + b * y - a) / (3 * y * y + b);
    return y;
}

}  // namespace

// Walton 1993; see theory.md. T is counted along its own direction, and the stiffness is that of the step's
// middle.
Vec3 ReferenceStep::slip_force(const PairPlan& p, Memory& m, const Vec3& slip, double normal) const {
    const double size = m.tangential.norm(), now = std::max(0.0, normal), limit = p.friction * now;
    Vec3 direction = size > 0 ? m.tangential : slip;
    if (direction.norm() > 0) direction.normalize();
    const double along = direction.dot(slip);
    const bool shrinks = along < 0, turns = shrinks != m.shrinks;
    if (turns) m.turning_ratio = m.pressed > 0 ? size / m.pressed : 0;
    m.turning_ratio = std::clamp(m.turning_ratio, -p.friction, p.friction);
    const double sign = shrinks ? -1 : 1, middle = 0.5 * (m.pressed + now);
    const double half = 0.5 * p.tangential_stiffness * std::abs(along);
    const double room = std::max((p.friction - sign * m.turning_ratio) * middle, 1e-6 * half + 1e-30);
    const double left = p.friction * middle - sign * size;
    const double share = softness(std::clamp(left / room, 1e-9, 1 + half / room), half / room, p.gamma);
    const double parallel = size + p.tangential_stiffness * (left > 0 ? std::min(1.0, share) : 0) * along;
    m.pressed = now;
    m.shrinks = shrinks;
    if (parallel < 0) m.turning_ratio = -m.turning_ratio, m.shrinks = false;
    if (now == 0) m.turning_ratio = 0;
    return capped(direction * parallel + p.tangential_stiffness * (slip - direction * along), limit);
}

}  // namespace grainreel
