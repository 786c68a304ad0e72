// The step loop for one pair of contact laws.
#pragma once

#include <cmath>
#include <istream>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "engine/base/binary.hpp"
#include "engine/base/error.hpp"
#include "engine/laws/contact_law.hpp"
#include "engine/step/contact_pass.hpp"
#include "engine/step/integrate.hpp"
#include "engine/step/step_loop.hpp"
#include "engine/step/wall_pass.hpp"

namespace grainreel {

template <class Law>
class LawLoop final : public StepLoop {
  public:
    LawLoop(const Plan& plan, const Surroundings& surroundings, Grains& grains, Team& team)
        : around_(surroundings),
          grains_(grains),
          team_(team),
          pairs_(plan.grain, plan.wall.size(), plan.arms),
          walls_(plan.wall, surroundings.faces, plan.arms),
          threads_(team.size()),
          farthest_(team.size()),
          parts_(team.size()) {}

    void restart() override {
        if constexpr (Law::uses_velocity) {
            grains_.end_velocity.resize(grains_.size());
            grains_.end_spin.resize(grains_.size());
        }
        const Pose rest = around_.motion.at(-1);
        pairs_.list = {};
        walls_.list.clear();
        team_.run([&](int member) { rebuild(member, rest); });
        rebuilds_ = 0;
        fresh_ = true;
        if constexpr (Law::uses_velocity) {
            for (std::size_t i = 0; i < grains_.size(); ++i) {
                grains_.end_velocity[i] = grains_.motion[i].velocity;
                grains_.end_spin[i] = grains_.spin[i].rate;
            }
        }
        // The first half kick wants the forces of where the grains are now: a step of no length gives them.
        team_.run([&](int member) { evaluate_forces(member, 0, rest, rest); });
    }

    void run(std::int64_t from, std::int64_t count, double step, double drag) override {
        const double keep = drag > 0 ? std::exp(-drag * step) : 1.0;
        if (fresh_) listed_step_ = from;
        fresh_ = false;
        team_.run([&](int member) {
            for (std::int64_t n = from; n < from + count; ++n) one_step(member, n, step, keep);
        });
    }

    void visit_contacts(std::int64_t at_step,
                        const std::function<void(const ContactView&)>& visit) const override {
        visit_pairs(visit);
        visit_walls(around_.motion.at(at_step), visit);
    }

    void save(std::ostream& out) const override {
        write_vector(out, pairs_.list.start);
        write_vector(out, pairs_.list.partner);
        write_vector(out, pairs_.history);
        write_vector(out, pairs_.touched);
        write_vector(out, walls_.list);
        write_vector(out, walls_.history);
        write_vector(out, walls_.touched);
        write_vector(out, listed_at_);
        write_value(out, listed_velocity_);
        write_value(out, listed_pose_);
        write_value(out, listed_step_);
    }

    void load(std::istream& in) override {
        read_vector(in, pairs_.list.start);
        read_vector(in, pairs_.list.partner);
        read_vector(in, pairs_.history);
        read_vector(in, pairs_.touched);
        read_vector(in, walls_.list);
        read_vector(in, walls_.history);
        read_vector(in, walls_.touched);
        read_vector(in, listed_at_);
        read_value(in, listed_velocity_);
        read_value(in, listed_pose_);
        read_value(in, listed_step_);
        if constexpr (Law::uses_velocity) {
            grains_.end_velocity.resize(grains_.size());
            grains_.end_spin.resize(grains_.size());
        }
        fresh_ = false;
        share_out();
    }

    std::int64_t rebuilds() const override { return rebuilds_; }
    std::size_t listed_pairs() const override { return pairs_.list.size(); }

  private:
    static constexpr bool rubs = Law::rubs;

    // From step n to n + 1, the part of one thread. A thread touches its own grains only, but for reading
    // positions and velocities between the second and third barrier, while nobody writes them.
    void one_step(int member, std::int64_t n, double step, double keep) {
        const Pose before = around_.motion.at(n), now = around_.motion.at(n + 1);
        const Vec3 drift = drift_since_listing(n + 1, step);
        farthest_[member].squared = kick_and_drift<rubs, Law::uses_velocity>(
            grains_, listed_at_, drift, around_.gravity, step, share_[member], share_[member + 1]);
        team_.barrier();
        if (lists_expired(now, drift)) {
            team_.barrier();  // nobody may rebuild while another still reads what lists_expired() reads
            rebuild(member, now);
            if (member == 0) listed_step_ = n + 1;
            team_.barrier();
        }
        evaluate_forces(member, step, before, now);
        kick<rubs>(grains_, around_.gravity, step, keep, share_[member], share_[member + 1]);
    }

    void evaluate_forces(int member, double step, const Pose& before, const Pose& now) {
        const std::int32_t begin = share_[member], end = share_[member + 1];
        pairs_.find_touching(grains_, begin, end, around_.period, threads_[member]);
        pairs_.compute(grains_, step, around_.period, end, threads_[member]);
        team_.barrier();
        gather<rubs>(threads_, member, begin, end, grains_);
        walls_.apply(grains_, step, before, now, begin, end);
    }

    // How far the bed as a whole has flown since the lists were made, were it in free flight. Displacements
    // count against this: it takes nothing from the safety of the lists, whatever the bed does, because two
    // grains come closer by at most the sum of what each moves against any common frame.
    Vec3 drift_since_listing(std::int64_t n, double step) const {
        const double time = static_cast<double>(n - listed_step_) * step;
        return time * (listed_velocity_ + 0.5 * time * around_.gravity);
    }

    bool lists_expired(const Pose& now, const Vec3& drift) const {
        double squared = 0;
        for (const Farthest& f : farthest_) squared = std::max(squared, f.squared);
        const double moved = std::sqrt(squared);
        const double still_face = drift.norm(),
                     moving_face = (now.offset - listed_pose_.offset - drift).norm();
        return 2 * moved > around_.skin || moved + std::max(still_face, moving_face) > around_.skin;
    }

    // New order, new lists, histories carried over: called by all members; the pair search is shared out.
    void rebuild(int member, const Pose& pose) {
        if (member == 0) {
            old_.take(pairs_, walls_);
            grains_.reorder(spatial_order(cells_, grains_, around_.skin, around_.period));
        }
        team_.barrier();
        const std::int64_t n = static_cast<std::int64_t>(grains_.size());
        list_pairs(cells_, grains_, around_.skin, around_.period,
                   static_cast<std::int32_t>(n * member / team_.size()),
                   static_cast<std::int32_t>(n * (member + 1) / team_.size()), parts_[member]);
        team_.barrier();
        if (member != 0) return;
        join_lists(parts_, pairs_.list);
        walls_.list = list_wall_neighbours(grains_, around_.faces, pose, around_.skin);
        pairs_.clear_history();
        walls_.clear_history();
        std::vector<std::int32_t> new_index(grains_.size());
        for (std::size_t i = 0; i < new_index.size(); ++i) new_index[cells_.order()[i]] = static_cast<int>(i);
        carry_pairs(new_index);
        carry_walls(new_index);
        note_listing(pose);
        share_out();
        ++rebuilds_;
    }

    void note_listing(const Pose& pose) {
        listed_at_.resize(grains_.size());
        listed_velocity_.setZero();
        for (std::size_t i = 0; i < grains_.size(); ++i) {
            listed_at_[i] = grains_.place[i].position;
            listed_velocity_ += grains_.motion[i].velocity;
        }
        listed_velocity_ /= static_cast<double>(grains_.size());
        listed_pose_ = pose;
    }

    // Ranges of grains for the threads, of about equal work: a grain costs about as much as three listed
    // pairs.
    void share_out() {
        const std::int32_t n = static_cast<std::int32_t>(grains_.size());
        const std::int64_t all = 3 * std::int64_t{n} + pairs_.list.start[n];
        share_.assign(team_.size() + 1, n);
        share_[0] = 0;
        std::int32_t i = 0;
        for (int t = 1; t < team_.size(); ++t) {
            while (i < n && (3 * std::int64_t{i} + pairs_.list.start[i]) * team_.size() < all * t) ++i;
            share_[t] = i;
        }
    }

    void carry_pairs(const std::vector<std::int32_t>& new_index) {
        const NeighbourList& old = old_.pairs;
        for (std::size_t i = 0; i + 1 < old.start.size(); ++i) {
            for (std::int32_t slot = old.start[i]; slot < old.start[i + 1]; ++slot) {
                if (!old_.touched[slot]) continue;
                std::int32_t first = new_index[i], second = new_index[old.partner[slot]];
                auto kept = old_.history[slot];
                if (first > second) {
                    std::swap(first, second);
                    kept.flip();
                }
                const auto begin = pairs_.list.partner.begin() + pairs_.list.start[first];
                const auto end = pairs_.list.partner.begin() + pairs_.list.start[first + 1];
                const auto found = std::find(begin, end, second);
                if (found == end) continue;  // they have parted since the last step, by more than the skin
                const std::size_t place = found - pairs_.list.partner.begin();
                pairs_.history[place] = kept;
                pairs_.touched[place] = 1;
            }
        }
    }

    void carry_walls(const std::vector<std::int32_t>& new_index) {
        const std::vector<WallNeighbour>& old = old_.walls;
        for (std::size_t entry = 0; entry < old.size(); ++entry) {
            if (!old_.wall_touched[entry]) continue;
            const std::int32_t grain = new_index[old[entry].grain];
            const auto lower = [](const WallNeighbour& w, std::int32_t g) { return w.grain < g; };
            auto found = std::lower_bound(walls_.list.begin(), walls_.list.end(), grain, lower);
            while (found != walls_.list.end() && found->grain == grain && found->face != old[entry].face)
                ++found;
            if (found == walls_.list.end() || found->grain != grain) continue;
            const std::size_t place = found - walls_.list.begin();
            walls_.history[place] = old_.wall_history[entry];
            walls_.touched[place] = 1;
        }
    }

    void visit_pairs(const std::function<void(const ContactView&)>& visit) const {
        for (std::int32_t i = 0; i + 1 < static_cast<std::int32_t>(pairs_.list.start.size()); ++i) {
            for (std::int32_t slot = pairs_.list.start[i]; slot < pairs_.list.start[i + 1]; ++slot) {
                if (!pairs_.touched[slot]) continue;
                const std::int32_t j = pairs_.list.partner[slot];
                const Place &one = grains_.place[i], &two = grains_.place[j];
                Vec3 apart = two.position - one.position;
                apart.x() = nearest_image(apart.x(), around_.period);
                const double distance = apart.norm();
                Touch touch{};
                touch.normal = apart / distance;
                touch.overlap = one.radius + two.radius - distance;
                touch.effective_mass = 1 / (grains_.motion[i].inverse_mass + grains_.motion[j].inverse_mass);
                touch.closing_speed =
                    touch.normal.dot(grains_.motion[i].velocity - grains_.motion[j].velocity);
                if (touch.overlap <= 0) continue;
                visit(view(i, j, touch, std::min(one.radius, two.radius), one.position, one.radius,
                           pairs_.parameters(grains_, i, j), pairs_.history[slot]));
            }
        }
    }

    void visit_walls(const Pose& pose, const std::function<void(const ContactView&)>& visit) const {
        for (std::size_t entry = 0; entry < walls_.list.size(); ++entry) {
            if (!walls_.touched[entry]) continue;
            const std::int32_t i = walls_.list[entry].grain;
            const Face& face = around_.faces[walls_.list[entry].face];
            const Place& place = grains_.place[i];
            const FaceDistance at =
                distance_to(face, face.moves ? pose.offset : Vec3::Zero(), place.position);
            Touch touch{};
            touch.normal = -at.normal;
            touch.overlap = place.radius - at.distance;
            touch.effective_mass = 1 / grains_.motion[i].inverse_mass;
            const Vec3 wall_velocity = face.moves ? pose.velocity : Vec3::Zero();
            touch.closing_speed = touch.normal.dot(grains_.motion[i].velocity - wall_velocity);
            if (touch.overlap <= 0) continue;
            visit(view(i, -1 - walls_.list[entry].face, touch, place.radius, place.position, place.radius,
                       walls_.parameters(grains_, i), walls_.history[entry]));
        }
    }

    static ContactView view(std::int32_t first, std::int32_t second, const Touch& touch,
                            double smaller_radius, const Vec3& centre, double radius,
                            const typename Law::Parameters& parameters, typename Law::History history) {
        ContactView v{};
        v.first = first;
        v.second = second;
        v.normal = touch.normal;
        v.overlap = touch.overlap;
        v.smaller_radius = smaller_radius;
        v.normal_force = Law::Normal::force(parameters.normal, history.normal, touch);
        v.tangential = Vec3::Zero();
        if constexpr (rubs) v.tangential = history.tangential.force;
        v.stored_energy = Law::stored_energy(parameters, history, touch, v.normal_force);
        v.point = centre + touch.normal * (radius - 0.5 * touch.overlap);
        return v;
    }

    // Lists and histories as they were, while new ones are made; kept to be filled again without allocation.
    struct Old {
        NeighbourList pairs;
        std::vector<typename Law::History> history;
        std::vector<std::uint8_t> touched;
        std::vector<WallNeighbour> walls;
        std::vector<typename Law::History> wall_history;
        std::vector<std::uint8_t> wall_touched;

        void take(ContactPass<Law>& p, WallPass<Law>& w) {
            std::swap(pairs, p.list);
            history.swap(p.history);
            touched.swap(p.touched);
            walls.swap(w.list);
            wall_history.swap(w.history);
            wall_touched.swap(w.touched);
        }
    };

    struct alignas(64) Farthest {
        double squared = 0;  // m2
    };

    const Surroundings& around_;
    Grains& grains_;
    Team& team_;
    Cells cells_;
    ContactPass<Law> pairs_;
    WallPass<Law> walls_;
    std::vector<ThreadContacts> threads_;
    std::vector<Farthest> farthest_;    // of each thread, since the lists were made
    std::vector<std::int32_t> share_;   // thread t owns the grains [share_[t], share_[t + 1])
    std::vector<NeighbourList> parts_;  // of the pair search, one a thread
    Old old_;
    // Where and how the grains and walls were when the lists were made.
    std::vector<Vec3> listed_at_;
    Vec3 listed_velocity_{0, 0, 0};
    Pose listed_pose_;
    std::int64_t listed_step_ = 0;
    bool fresh_ = true;  // restarted: the next run() says at which step the lists were made
    std::int64_t rebuilds_ = 0;
};

}  // namespace grainreel
