#include "render/page/bed/page_bed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>

#include "render/page/embed.hpp"
#include "render/picture/base/shot.hpp"

namespace grainreel {

namespace {

constexpr double steps = 65535;  // steps of a 16-bit number
constexpr std::uint8_t most_contacts = 254, unknown_contacts = 255;
constexpr double usual_packed = 7;  // bytes a grain and moment: shaken beds take 6.2 to 6.6

// A grain that the page has.
struct Kept {
    std::int32_t id = 0;
    std::int32_t species = 0;
    double radius = 0;       // m
    double from_middle = 0;  // m, |x| at the moment when it was first seen
};

// Numbers evenly spread over 0 ... count - 1, with both ends.
std::vector<std::size_t> spread(std::size_t count, std::size_t wanted) {
    std::vector<std::size_t> chosen;
    wanted = std::clamp<std::size_t>(wanted, 1, count);
    for (std::size_t i = 0; i < wanted; ++i)
        chosen.push_back(wanted == 1 ? 0 : (i * (count - 1) + (wanted - 1) / 2) / (wanted - 1));
    return chosen;
}

// Elements evenly spread over the list, with the first and the last.
std::vector<std::size_t> those_of(const std::vector<std::size_t>& list, std::size_t wanted) {
    std::vector<std::size_t> those;
    if (wanted == 0) return those;
    for (const std::size_t at : spread(list.size(), wanted)) those.push_back(list[at]);
    return those;
}

// Appends a number in the machine's byte order. x86 and ARM are little-endian, as the page needs it.
template <class Number>
void append(std::vector<std::uint8_t>& bytes, Number number) {
    static_assert(std::endian::native == std::endian::little);
    std::array<std::uint8_t, sizeof(Number)> raw;
    std::memcpy(raw.data(), &number, sizeof number);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

// Merges two rising lists into one rising list.
std::vector<std::size_t> merged(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
    std::vector<std::size_t> all;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
    return all;
}

class BedWriter {
  public:
    BedWriter(const StateArchive& run, const PageProgress& progress, const PageContacts& contacts)
        : run_(run), progress_(progress), contacts_(contacts), moves_(run.supply().velocities) {}

    // keys: the chosen moments whose pairs are kept.
    PageBed write(const std::vector<std::size_t>& chosen, const std::vector<std::size_t>& keys) {
        survey(chosen);
        bytes_.clear();
        for (const Kept& grain : kept_) append(bytes_, grain.id);
        for (const Kept& grain : kept_) append(bytes_, static_cast<std::uint16_t>(grain.species));
        for (const Kept& grain : kept_) append(bytes_, static_cast<float>(grain.radius));
        before_.assign(3 * kept_.size(), 0);
        PairForcesWriter forces;
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            go_on_or_stop(progress_, static_cast<double>(k + 1) / static_cast<double>(chosen.size()));
            const bool is_key = std::binary_search(keys.begin(), keys.end(), chosen[k]);
            Shot frame = run_.grains(chosen[k]);
            const bool for_film = contacts_.film != nullptr && contacts_.film->wants_touches();
            const auto touches = touches_of(chosen[k], is_key || for_film || frame.contact_number.empty());
            add(frame, touches);
            if (contacts_.film != nullptr) add_film_colours(chosen[k], frame, touches);
            if (is_key && touches) forces.add(k, *touches, slot_);
        }
        bed_.packed = zlib_packed(bytes_);
        bed_.forces = forces.written();
        return std::move(bed_);
    }

  private:
    std::optional<std::vector<Link>> touches_of(std::size_t index, bool wanted) const {
        return wanted && contacts_.touches ? contacts_.touches(index) : std::nullopt;
    }

    // Finds the grains, the box around them, and the range of their speeds.
    void survey(const std::vector<std::size_t>& chosen) {
        bed_ = PageBed();
        bed_.has_film_colours = contacts_.film != nullptr;
        boxed_ = false;
        bed_.all_moments = run_.moments().size();
        std::map<std::int32_t, Kept> seen;
        for (const std::size_t index : chosen) {
            bed_.moments.push_back(run_.moments()[index]);
            const State frame = run_.grains(index);
            for (std::size_t i = 0; i < frame.size(); ++i) {
                seen.try_emplace(frame.id[i], Kept{frame.id[i], frame.species[i], frame.radius[i],
                                                   std::abs(frame.position[i].x())});
                bed_.highest_speed = std::max(bed_.highest_speed, frame.velocity[i].norm());  // none for NaN
                take_into_box(frame.position[i]);
            }
        }
        bed_.lowest_speed = bed_.highest_speed / kByteSpan;
        bed_.all_grains = seen.size();
        choose(seen);
    }

    void take_into_box(const Vec3& place) {
        bed_.low = boxed_ ? bed_.low.cwiseMin(place).eval() : place;
        bed_.high = boxed_ ? bed_.high.cwiseMax(place).eval() : place;
        boxed_ = true;
    }

    void choose(const std::map<std::int32_t, Kept>& seen) {
        kept_.clear();
        for (const auto& [id, grain] : seen) kept_.push_back(grain);
        if (kept_.size() > kMostGrainsOnPage) {
            std::stable_sort(kept_.begin(), kept_.end(),
                             [](const Kept& a, const Kept& b) { return a.from_middle < b.from_middle; });
            kept_.resize(kMostGrainsOnPage);
            std::sort(kept_.begin(), kept_.end(), [](const Kept& a, const Kept& b) { return a.id < b.id; });
        }
        slot_.clear();
        for (std::size_t i = 0; i < kept_.size(); ++i) slot_[kept_[i].id] = i;
        bed_.grains = kept_.size();
    }

    void add(const State& frame, const std::optional<std::vector<Link>>& touches) {
        const std::size_t n = kept_.size(), begin = bytes_.size();
        bytes_.resize(begin + 9 * n, 0);
        std::uint8_t* const at = bytes_.data() + begin;
        const bool told = !frame.contact_number.empty();
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const auto found = slot_.find(frame.id[i]);
            if (found == slot_.end()) continue;
            const std::size_t grain = found->second;
            for (int axis = 0; axis < 3; ++axis) add_place(at, axis, grain, frame.position[i][axis]);
            at[6 * n + grain] =
                moves_ ? speed_byte(frame.velocity[i].norm(), bed_.lowest_speed, bed_.highest_speed)
                       : kUnknownSpeed;
            if (told) at[7 * n + grain] = contact_byte(frame.contact_number[i]);
            at[8 * n + grain] = 1;
        }
        if (!told && touches) count_contacts(*touches, at + 7 * n);
        if (!told && !touches) std::fill_n(at + 7 * n, n, unknown_contacts);
        if (told || touches) ++bed_.counted;
    }

    void add_film_colours(std::size_t index, Shot& frame, const std::optional<std::vector<Link>>& touches) {
        const std::size_t begin = bytes_.size();
        bytes_.resize(begin + kept_.size(), 0);
        const std::vector<std::uint8_t> colours = contacts_.film->of(index, frame, touches);
        bool known = frame.size() == 0;
        for (std::size_t i = 0; i < frame.size(); ++i)
            if (const auto found = slot_.find(frame.id[i]); found != slot_.end()) {
                bytes_[begin + found->second] = colours[i];
                known = known || colours[i] > 0;
            }
        bed_.film_coloured += known;
    }

    static std::uint8_t contact_byte(std::int32_t number) {
        return static_cast<std::uint8_t>(std::clamp<std::int32_t>(number, 0, most_contacts));
    }

    void add_place(std::uint8_t* at, int axis, std::size_t grain, double place) {
        const std::size_t n = kept_.size();
        const double length = bed_.high[axis] - bed_.low[axis];
        const double share = length > 0 ? (place - bed_.low[axis]) / length : 0;
        const auto number = static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * steps));
        std::uint16_t& before = before_[3 * grain + axis];
        const auto change = static_cast<std::int16_t>(static_cast<std::uint16_t>(number - before));
        const auto zigzag = static_cast<std::uint16_t>((change << 1) ^ (change >> 15));
        at[(2 * axis) * n + grain] = static_cast<std::uint8_t>(zigzag & 0xff);
        at[(2 * axis + 1) * n + grain] = static_cast<std::uint8_t>(zigzag >> 8);
        before = number;
    }

    // Counts the contacts of each grain that carry a force.
    void count_contacts(const std::vector<Link>& touches, std::uint8_t* counts) const {
        const auto count = [&](std::int32_t id) {
            const auto found = slot_.find(id);
            if (found != slot_.end() && counts[found->second] < most_contacts) ++counts[found->second];
        };
        for (const Link& touch : touches) {
            if (!(touch.force > 0)) continue;
            count(touch.first);
            count(touch.second);  // a wall's number is negative, and no grain has it
        }
    }

    const StateArchive& run_;
    const PageProgress& progress_;
    const PageContacts& contacts_;
    const bool moves_;  // whether velocities are known
    bool boxed_ = false;
    PageBed bed_;
    std::vector<Kept> kept_;  // the grains, by rising id
    std::map<std::int32_t, std::size_t> slot_;
    std::vector<std::uint8_t> bytes_;
    std::vector<std::uint16_t> before_;  // places at the moment before, three numbers for each grain
};

std::size_t most_grains_at_once(const StateArchive& run) {
    return std::min(kMostGrainsOnPage, run.first_whole().size());
}

}  // namespace

std::uint8_t speed_byte(double speed, double lowest, double highest) {
    if (std::isnan(speed)) return kUnknownSpeed;
    if (!(speed >= lowest) || lowest <= 0) return 0;
    const double share = std::log(speed / lowest) / std::log(highest / lowest);
    return static_cast<std::uint8_t>(1 + std::lround(253 * std::clamp(share, 0.0, 1.0)));
}

PageBed page_bed_of(const StateArchive& run, const std::vector<std::size_t>& chosen,
                    const PageProgress& progress, const PageContacts& contacts) {
    return BedWriter(run, progress, contacts).write(chosen, {});
}

PageBed page_bed(const StateArchive& run, std::size_t most_bytes, const PageProgress& progress,
                 const PageContacts& contacts) {
    const std::size_t all = run.moments().size();
    const double a_moment =
        usual_packed * static_cast<double>(std::max<std::size_t>(1, most_grains_at_once(run)));
    auto wanted = static_cast<std::size_t>(
        std::clamp(static_cast<double>(most_bytes) / a_moment, 1.0, static_cast<double>(all)));
    std::vector<std::size_t> keys = contacts.keys;
    BedWriter writer(run, progress, contacts);
    while (true) {
        PageBed bed = writer.write(merged(spread(all, wanted), keys), keys);
        if (bed.bytes() <= most_bytes || (wanted == 1 && keys.empty())) return bed;
        const double fits = 0.97 * static_cast<double>(most_bytes) / static_cast<double>(bed.bytes());
        const auto less = [&](std::size_t count) {
            return static_cast<std::size_t>(fits * static_cast<double>(count));
        };
        wanted = std::max<std::size_t>(1, less(wanted));
        // If all key moments would take more than half of the bytes, some are dropped.
        if (2 * keys.size() * static_cast<std::size_t>(a_moment) > most_bytes)
            keys = those_of(keys, less(keys.size()));
    }
}

namespace {

constexpr std::uint32_t most_bodies = 0xffffff;

// Appends numbers below 2^24: first all low bytes, then all middle ones, then all high ones.
void append_planes(std::vector<std::uint8_t>& bytes, const std::vector<std::uint32_t>& numbers) {
    for (const int shift : {0, 8, 16})
        for (const std::uint32_t number : numbers)
            bytes.push_back(static_cast<std::uint8_t>((number >> shift) & 0xff));
}

}  // namespace

void PairForcesWriter::add(std::size_t moment, const std::vector<Link>& touches,
                           const std::map<std::int32_t, std::size_t>& slots) {
    std::vector<Pair> pairs;
    for (const Link& touch : touches) {
        if (!(touch.force > 0)) continue;
        const auto first = slots.find(touch.first), second = slots.find(touch.second);
        if (first == slots.end() || (second == slots.end() && touch.second >= 0)) continue;
        const std::uint32_t other = touch.second >= 0
                                        ? static_cast<std::uint32_t>(second->second)
                                        : most_bodies - static_cast<std::uint32_t>(-1 - touch.second);
        pairs.push_back({static_cast<std::uint32_t>(first->second), other, touch.force});
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.first < b.first; });
    moments_.push_back({moment, pairs.size()});
    pairs_.push_back(std::move(pairs));
}

PairForces PairForcesWriter::written() const {
    PairForces forces;
    forces.moments = moments_;
    for (const auto& pairs : pairs_)
        for (const Pair& pair : pairs) forces.highest = std::max(forces.highest, pair.force);
    forces.lowest = forces.highest / kByteSpan;
    std::vector<std::uint8_t> bytes;
    for (const auto& pairs : pairs_) {
        std::vector<std::uint32_t> firsts, seconds;
        std::uint32_t before = 0;
        for (const Pair& pair : pairs) {
            firsts.push_back(pair.first - before);
            seconds.push_back(pair.second);
            before = pair.first;
        }
        append_planes(bytes, firsts);
        append_planes(bytes, seconds);
        for (const Pair& pair : pairs) bytes.push_back(speed_byte(pair.force, forces.lowest, forces.highest));
    }
    if (!moments_.empty()) forces.packed = zlib_packed(bytes);
    return forces;
}

}  // namespace grainreel
