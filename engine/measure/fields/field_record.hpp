// Fields by coarse-graining as a run goes on: it gathers moments, and has the mean of each record when the
// record ends.
#pragma once

#include <iosfwd>
#include <optional>

#include "engine/base/binary.hpp"
#include "engine/measure/fields/coarse_graining.hpp"
#include "engine/plan/times.hpp"

namespace grainreel {

class FieldRecord {
  public:
    FieldRecord(const Scene& scene, const FieldTimes& times);

    const CoarseGraining& sums() const { return sums_; }
    const FieldTimes& times() const { return times_; }
    // At the step where the run begins, or goes on without what was gathered before: then gathering waits for
    // the next record. `state` is that of the step.
    void start(std::int64_t step, const FieldState& state);
    // At every step that times().next() names.
    void gather(std::int64_t step, const FieldState& state);
    // The mean over the record that ended last; none before the first has ended.
    const std::optional<CoarseFields>& last() const { return last_; }

    // What was gathered of the record that goes on, and the mean of the one that has ended just now: it may
    // not have been written yet.
    void save(std::ostream& out) const;
    // Makes the reading fail where save() could not have written what is read. What was gathered with other
    // settings is left: gathering then waits for the next record.
    void load(Bytes& in);

  private:
    FieldTimes times_;
    std::vector<double> settings_;  // by which saved sums are told from those of other fields
    CoarseGraining sums_;
    void load_last(Bytes& in);

    bool open_ = false;   // whether a record has begun
    bool ended_ = false;  // whether one ended at the step that was gathered last
    std::optional<CoarseFields> last_;
};

}  // namespace grainreel
