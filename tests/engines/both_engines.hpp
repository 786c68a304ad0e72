// One scene run by another engine on two ranks and by ours, with the same laws, steps and start: what is seen
// at the same moments.
#pragma once

#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/handover/carry.hpp"

namespace grainreel::test {

// Grains at one moment, in the lab; by rising id.
struct Moment {
    double time = 0;  // s
    std::vector<int> species;
    std::vector<double> radius;  // m
    std::vector<Vec3> position;  // m
    std::size_t size() const { return species.size(); }
};
using Course = std::vector<Moment>;  // by rising time

struct BothCourses {
    CarriedScene carried;
    Course theirs, ours;
    std::string failure;  // of the engine; empty where it has none
};
// Both at a time: theirs on two ranks, then ours. Throws UserError for a scene that is not carried.
BothCourses run_both(const std::string& text, const CarryRequest& request);

// Means over the moments from a time on, of one run.
double mean_height(const Course& course, double from, int species);  // m
// Contacts of a grain with others. periodic: m, along x; 0 where nothing is.
double mean_contacts(const Course& course, double from, double periodic);
double mean_turning_weight(const Course& course, double from, double density);  // N m about the x axis
double grains_left(const Course& course);                                       // of those at the start

}  // namespace grainreel::test
