#include "engine/step/contact_pass.hpp"

#include <algorithm>
#include <utility>

#include "engine/step/loads.hpp"

namespace grainreel {

namespace {

// Kinds that do not differ are one: no lookup.
LawParameters one_if_equal(LawParameters p) {
    std::vector<double> first;
    for (std::size_t row = 0; row < p.values.size(); row += p.kinds) {
        const auto begin = p.values.begin() + row;
        if (std::any_of(begin, begin + p.kinds, [&](double v) { return v != *begin; })) return p;
        first.push_back(*begin);
    }
    return {first, 1};
}

}  // namespace

ContactRules::ContactRules(const Plan& plan, double period_of_x)
    : law(&law_kernel(plan.normal, plan.tangential)),
      of_pairs(one_if_equal(law->parameters(plan.grain))),
      of_walls(one_if_equal(law->parameters(plan.wall))),
      species(static_cast<std::int32_t>(plan.wall.size())),
      arms(plan.arms),
      period(period_of_x) {}

namespace {

bool near(const Grains& grains, std::int32_t i, std::int32_t j, double period, double skin) {
    const Place &one = grains.place[i], &two = grains.place[j];
    Vec3 apart = two.position - one.position;
    apart.x() = nearest_image(apart.x(), period);
    const double limit = one.radius + two.radius + skin;
    return apart.squaredNorm() < limit * limit;
}

void add_near_walls(ContactList& walls, const Grains& grains, const std::vector<WallNeighbour>& list,
                    const std::vector<Face>& faces, const Vec3& offset, double skin, std::int32_t begin,
                    std::int32_t end) {
    const auto lower = [](const WallNeighbour& w, std::int32_t grain) { return w.grain < grain; };
    std::size_t slot = std::lower_bound(list.begin(), list.end(), begin, lower) - list.begin();
    for (; slot < list.size() && list[slot].grain < end; ++slot) {
        const Place& place = grains.place[list[slot].grain];
        const Face& face = faces[list[slot].face];
        const Vec3 moved = face.moves ? offset : Vec3::Zero();
        if (distance_to(face, moved, place.position).distance < place.radius + skin) {
            walls.add(static_cast<std::int32_t>(slot), list[slot].grain, list[slot].face);
        }
    }
}

void note_kinds(ContactList& list, const Grains& grains, const ContactRules& rules, bool of_pairs) {
    const bool kinds = (of_pairs ? rules.of_pairs : rules.of_walls).kinds > 1;
    if (!kinds && !rules.law->uses_velocity) return;
    for (std::int32_t c = 0; c < list.filled(); ++c) {
        const std::int32_t i = list.first[c], j = list.second[c];
        list.kind[c] = of_pairs ? grains.species[i] * rules.species + grains.species[j] : grains.species[i];
        const double inverse = grains.motion[i].inverse_mass + (of_pairs ? grains.motion[j].inverse_mass : 0);
        list.set_effective_mass(c, 1 / inverse);
    }
}

}  // namespace

void ContactPass::own(const NeighbourLists& lists, std::int32_t begin, std::int32_t end) {
    begin_ = begin;
    end_ = end;
    incoming_.clear();
    const NeighbourList& list = lists.pairs;
    for (std::int32_t i = std::max(0, begin - list.farthest_partner); i < begin; ++i) {
        for (std::int32_t slot = list.start[i]; slot < list.start[i + 1]; ++slot) {
            if (list.partner[slot] >= begin && list.partner[slot] < end) incoming_.push_back({slot, i});
        }
    }
}

void ContactPass::refresh(const ContactRules& rules, const Grains& grains, const NeighbourLists& lists,
                          const std::vector<Face>& faces, const Vec3& wall_offset, double skin,
                          bool carry_histories) {
    const NeighbourList& list = lists.pairs;
    pairs_.begin(rules.law->history_size);
    for (const auto& [slot, i] : incoming_) {
        if (near(grains, i, list.partner[slot], rules.period, skin)) pairs_.add(slot, i, list.partner[slot]);
    }
    for (std::int32_t i = begin_; i < end_; ++i) {
        for (std::int32_t slot = list.start[i], last = list.start[i + 1]; slot < last; ++slot) {
            const std::int32_t j = list.partner[slot];
            if (near(grains, i, j, rules.period, skin)) pairs_.add(slot, i, j);
        }
    }
    walls_.begin(rules.law->history_size);
    add_near_walls(walls_, grains, lists.walls, faces, wall_offset, skin, begin_, end_);
    for (ContactList* each : {&pairs_, &walls_}) {
        each->end(carry_histories);
        note_kinds(*each, grains, rules, each == &pairs_);
    }
}

void ContactPass::restore(const ContactRules& rules, const KeptContacts& kept,
                          const std::vector<std::int32_t>& index) {
    const auto own = [&](std::int32_t grain) { return grain >= begin_ && grain < end_; };
    const std::size_t numbers = rules.law->history_size;
    std::vector<double> turned(numbers);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const bool of_pairs = k < kept.pairs;
        std::int32_t i = index[kept.first[k]], j = of_pairs ? index[kept.second[k]] : kept.second[k];
        if (!own(i) && !(of_pairs && own(j))) continue;
        const double sign = of_pairs && i > j ? -1 : 1;
        if (sign < 0) std::swap(i, j);
        for (std::size_t h = 0; h < numbers; ++h) {
            const double value = kept.history[k * numbers + h];
            turned[h] = rules.law->turns[h] ? sign * value : value;
        }
        // A contact not found has parted since the last step.
        (of_pairs ? pairs_ : walls_).restore(i, j, turned.data());
    }
}

// Sets touch_ for a chunk after the other and calls law(input, number of the chunk's first contact).
template <class Law>
void ContactPass::each_chunk(const ContactRules& rules, const Grains& grains, const WallState& state,
                             bool of_pairs, double step, const Law& law) const {
    const ContactList& list = of_pairs ? pairs_ : walls_;
    const LawParameters* parameters = of_pairs ? &rules.of_pairs : &rules.of_walls;
    for (std::int32_t c = 0; c < list.size(); c += kChunk) {
        const int count = std::min(kChunk, list.size() - c);
        const GeometryInput in{&grains, list.first.data() + c, list.second.data() + c,
                               count,   wants_of(*rules.law),  rules.arms,
                               step};
        of_pairs ? touch_pairs(in, rules.period, touch_) : touch_walls(in, state, touch_);
        if (count < kChunk) touch_.touching &= (std::uint64_t{1} << count) - 1;  // not the fill
        law(LawInput{count, &touch_, list.mass_of_block(c), list.kind.data() + c, parameters, step}, c);
    }
}

void ContactPass::compute(const ContactRules& rules, Grains& grains, const WallState& state, double step) {
    const auto chunk = [&](const LawInput& in, ContactList& list, std::int32_t c) {
        rules.law->step(in, list.history_of_block(c), force_);
        return ChunkOfContacts{list.first.data() + c, list.second.data() + c, in.count, &touch_, &force_,
                               rules.law->rubs};
    };
    each_chunk(rules, grains, state, true, step, [&](const LawInput& in, std::int32_t c) {
        add_pairs(chunk(in, pairs_, c), loads_, begin_, end_, grains);
    });
    each_chunk(rules, grains, state, false, step, [&](const LawInput& in, std::int32_t c) {
        add_walls(chunk(in, walls_, c), loads_, state, step, grains);
    });
}

void ContactPass::observe(const ContactRules& rules, const Grains& grains, const WallState& state,
                          bool of_pairs, const Seen& seen) const {
    const ContactList& list = of_pairs ? pairs_ : walls_;
    each_chunk(rules, grains, state, of_pairs, 0, [&](const LawInput& in, std::int32_t c) {
        rules.law->observe(in, list.history_of_block(c), force_);
        for (int k = 0; k < in.count; ++k) {
            if ((touch_.touching >> k & 1) && list.first[c + k] >= begin_)
                seen(list.first[c + k], list.second[c + k], k, touch_, force_);
        }
    });
}

}  // namespace grainreel
