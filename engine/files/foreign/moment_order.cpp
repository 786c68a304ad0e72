#include "engine/files/foreign/moment_order.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace grainreel {

namespace {

using Key = double;  // the step or the time of a moment
using Parts = std::vector<PlacedMoment>;
using Known = std::map<Key, Parts>;
using GoneBack = OrderedMoments::GoneBack;
using AreParts = OrderedMoments::AreParts;

// A gap so many times as wide as the frames beside it are apart is one that a piece of the run fills.
constexpr double clearly_wider = 1.5;

// Frames that were written one after the other, with keys that do not fall.
struct Stretch {
    std::vector<PlacedMoment> frames;
    std::vector<Key> keys;
    Key first() const { return keys.front(); }
    Key last() const { return keys.back(); }
};

class Order {
  public:
    // room: share of a key by which two keys may differ and still be the same.
    Order(double room, const AreParts& are_parts) : room_(room), are_parts_(are_parts) {}

    // Adds frames in the order in which they were written.
    void add_all(const std::vector<PlacedMoment>& all,
                 const std::function<Key(const PlacedMoment&)>& key_of) {
        Stretch stretch;
        for (const PlacedMoment& one : all) {
            const Key key = key_of(one);
            const bool goes_on =
                !stretch.keys.empty() &&
                (key > stretch.last() || (key == stretch.last() && one.file != stretch.frames.back().file));
            if (!goes_on && !stretch.keys.empty()) {
                add(stretch);
                stretch = {};
            }
            stretch.frames.push_back(one);
            stretch.keys.push_back(key);
        }
        if (!stretch.keys.empty()) add(stretch);
    }
    const Known& known() const { return known_; }
    const GoneBack& gone_back() const { return gone_back_; }

  private:
    Key a_little_before(Key key) const { return key - room_ * std::abs(key); }
    Key a_little_after(Key key) const { return key + room_ * std::abs(key); }

    void add(const Stretch& stretch) {
        if (known_.empty() || stretch.first() > known_.rbegin()->first || is_of_another_process(stretch) ||
            is_piece_in_wrong_place(stretch))
            return put(stretch);
        const bool begins_before = a_little_after(stretch.first()) < known_.begin()->first;
        if (!begins_before) note_return(stretch);
        give_up(stretch, begins_before);
        put(stretch);
    }
    void put(const Stretch& stretch) {
        for (std::size_t k = 0; k < stretch.keys.size(); ++k)
            known_[stretch.keys[k]].push_back(stretch.frames[k]);
    }

    // Whether another process wrote the same moments of other grains into another file.
    bool is_of_another_process(const Stretch& stretch) const {
        for (std::size_t k = 0; k < stretch.keys.size(); ++k) {
            const auto same = known_.find(stretch.keys[k]);
            if (same == known_.end()) continue;
            const PlacedMoment &one = same->second.back(), &other = stretch.frames[k];
            if (one.file == other.file) return false;
            if (one.moment.grains > 0 && other.moment.grains > 0) return are_parts_(one, other);
        }
        return has_the_same_keys(stretch);
    }

    // Whether no frame says whether grains are the same, but the file has exactly the moments of another.
    bool has_the_same_keys(const Stretch& stretch) const {
        return stretch.keys.size() == known_.size() &&
               stretch.frames.front().file != known_.begin()->second.back().file &&
               std::equal(stretch.keys.begin(), stretch.keys.end(), known_.begin(),
                          [](Key key, const auto& one) { return key == one.first; });
    }

    // Pieces of a run may lie in any order in a file: steps 0 to 10, 21 to 30, then 11 to 20. A piece fills a
    // gap that is wider than the frames beside it are apart, or lies before all frames so far.
    bool is_piece_in_wrong_place(const Stretch& stretch) const {
        if (a_little_after(stretch.last()) < known_.begin()->first) return true;
        const auto after = known_.lower_bound(a_little_before(stretch.first()));
        if (after == known_.begin() || after == known_.end()) return false;
        const Key before = std::prev(after)->first;
        if (after->first <= a_little_after(stretch.last())) return false;
        const Key typical = typical_distance(stretch, before);
        return typical > 0 && after->first - before > clearly_wider * typical;
    }

    // The distance of frames in the stretch; where it has a single one, of the frames before the gap.
    Key typical_distance(const Stretch& stretch, Key before) const {
        if (stretch.last() > stretch.first())
            return (stretch.last() - stretch.first()) / static_cast<double>(stretch.keys.size() - 1);
        const auto one = known_.find(before);
        return one == known_.begin() ? 0 : before - std::prev(one)->first;
    }

    void note_return(const Stretch& stretch) {
        if (gone_back_.twice + gone_back_.given_up > 0) return;
        gone_back_.from = known_.rbegin()->first;
        gone_back_.to = stretch.first();
    }

    // Removes what the stretch replaces: all from its first frame on. A stretch that begins before all known
    // frames replaces those within it.
    void give_up(const Stretch& stretch, bool begins_before) {
        const auto from = known_.lower_bound(a_little_before(stretch.first()));
        const auto to = begins_before ? known_.upper_bound(a_little_after(stretch.last())) : known_.end();
        for (auto one = from; one != to; ++one) {
            const auto same =
                std::lower_bound(stretch.keys.begin(), stretch.keys.end(), a_little_before(one->first));
            const bool again = same != stretch.keys.end() && *same <= a_little_after(one->first);
            ++(again ? gone_back_.twice : gone_back_.given_up);
        }
        known_.erase(from, to);
    }

    double room_;
    const AreParts& are_parts_;
    Known known_;
    GoneBack gone_back_;
};

}  // namespace

OrderedMoments in_order(const std::vector<PlacedMoment>& all, const AreParts& are_parts) {
    const auto has = [&](auto member) {
        return std::all_of(all.begin(), all.end(),
                           [&](const PlacedMoment& one) { return (one.moment.*member).has_value(); });
    };
    OrderedMoments made;
    const bool stepped = has(&RawMoment::step);
    if (!stepped && !has(&RawMoment::time)) {
        for (const PlacedMoment& one : all) made.moments.push_back({one});
        return made;
    }
    const auto key_of = [&](const PlacedMoment& one) {
        return stepped ? static_cast<double>(*one.moment.step) : *one.moment.time;
    };
    const double room = stepped ? 0 : 1e-9;
    const auto note = [&](const GoneBack& more) {
        if (made.gone_back.twice + made.gone_back.given_up == 0)
            made.gone_back.from = more.from, made.gone_back.to = more.to;
        made.gone_back.twice += more.twice;
        made.gone_back.given_up += more.given_up;
    };
    // Each file by itself, and then all files together, because each of several processes may have gone back.
    std::vector<PlacedMoment> by_file;
    for (auto begin = all.begin(); begin != all.end();) {
        const auto end =
            std::find_if(begin, all.end(), [&](const PlacedMoment& one) { return one.file != begin->file; });
        Order order(room, are_parts);
        order.add_all({begin, end}, key_of);
        for (const auto& [key, parts] : order.known()) by_file.push_back(parts.front());
        note(order.gone_back());
        begin = end;
    }
    Order order(room, are_parts);
    order.add_all(by_file, key_of);
    note(order.gone_back());
    for (const auto& [key, parts] : order.known()) made.moments.push_back(parts);
    return made;
}

}  // namespace grainreel
