// Puts the moments that a run's files hold into their order. A run that went on from an earlier moment wrote
// again from there; what had been written after that moment was given up, and is left out.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

// A moment, and where it is: the number of its file and of its frame in the file.
struct PlacedMoment {
    RawMoment moment;
    std::size_t file = 0, frame = 0;
};

struct OrderedMoments {
    // Whether two frames of one moment, in two files, have different grains, so that they are parts of one
    // frame.
    using AreParts = std::function<bool(const PlacedMoment&, const PlacedMoment&)>;

    // What was left out because the run had gone on from an earlier moment.
    struct GoneBack {
        std::size_t twice = 0;     // frames of steps (or times) that came again
        std::size_t given_up = 0;  // other frames after the moment from which the run went on
        double from = 0, to = 0;   // the first time: from this step to that one; times in the file's unit
    };

    // By rising step, or else by time, or else as they were written. Files that several processes wrote for
    // one moment are together.
    std::vector<std::vector<PlacedMoment>> moments;
    GoneBack gone_back;
};

// all: in the order in which they were written, file after file. Frames that stand in the wrong order only
// because pieces of a run do are all kept.
OrderedMoments in_order(const std::vector<PlacedMoment>& all, const OrderedMoments::AreParts& are_parts);

}  // namespace grainreel
