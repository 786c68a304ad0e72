// The bed as the page carries it: the places of grains, in 16 bits for each axis, moment by moment.
//
// The bytes, before they are packed, are for N grains and K moments, little-endian:
//   ids, N int32; species, N uint16; radii in m, N float32;
//   then for each moment: x, y and z, each as N low bytes and N high bytes of a zigzag difference from the
//   moment before (from 0 at first); N bytes of speed; N contact numbers; N bytes of presence; and, where the
//   film colours its grains by a quantity, N bytes of that (film_colours.hpp).
// A contact number of 255 is not known. Where a grain is not present, its speed and presence are 0, and its
// place repeats the one before. render/page/html/page_bed.js reads them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"
#include "render/page/bed/film_colours.hpp"
#include "render/page/embed.hpp"

namespace grainreel {

// Which grains push each other, and how hard, at key moments. The page draws this as force chains.
//
// The bytes, before they are packed, are for each key moment of P pairs: low, middle and high bytes of the
// first grain's place in the list of grains, as its difference from the pair before (P each); the same three
// bytes of the second grain's place itself, or of 2^24 - 1 - face for a wall; P bytes of normal force, coded
// as speed_byte() codes speeds. render/page/html/pair_forces.js reads them.
struct PairForces {
    struct Moment {
        std::size_t moment = 0;  // index among the moments of the page
        std::size_t pairs = 0;
    };
    std::vector<Moment> moments;
    std::vector<std::uint8_t> packed;  // in zlib's format
    double lowest = 0, highest = 0;    // N, what the forces' bytes 1 and 254 stand for
};

class PairForcesWriter {
  public:
    // Adds the next key moment. Pairs with a grain that the page lacks are left out. slots: for each id, the
    // grain's place in the list of grains.
    void add(std::size_t moment, const std::vector<Link>& touches,
             const std::map<std::int32_t, std::size_t>& slots);
    PairForces written() const;

  private:
    struct Pair {
        std::uint32_t first = 0, second = 0;
        double force = 0;  // N
    };
    std::vector<PairForces::Moment> moments_;
    std::vector<std::vector<Pair>> pairs_;
};

struct PageBed {
    std::vector<std::uint8_t> packed;             // in zlib's format
    std::vector<State> moments;                   // the moments that the page has, as frames without grains
    std::size_t grains = 0;                       // N
    std::size_t all_grains = 0, all_moments = 0;  // numbers in the run
    Vec3 low{0, 0, 0}, high{0, 0, 0};             // m, the box of all centres, which 16 bits span
    double lowest_speed = 0, highest_speed = 0;   // m/s, what the speed's bytes 1 and 254 stand for
    std::size_t counted = 0;                      // number of moments whose contact numbers are known
    bool has_film_colours = false;
    std::size_t film_coloured = 0;  // number of moments at which the film's quantity is known for some grain
    PairForces forces;

    // The error of a place along each axis in m: half a step of 16 bits.
    Vec3 error() const { return (high - low) / (2 * 65535.0); }
    std::size_t bytes() const { return packed.size() + forces.packed.size(); }
};

// What a page has besides places and speeds.
struct PageContacts {
    // Gives the contacts of a moment by its index; none when they are not known.
    std::function<std::optional<std::vector<Link>>(std::size_t)> touches;
    std::vector<std::size_t> keys;  // moments whose pairs the page should have, by rising index
    FilmColours* film = nullptr;    // null when the film shows the species
};

constexpr std::size_t kMostGrainsOnPage = 100000;

// The page's frames: as many evenly spread moments of the run as fit into `most_bytes` packed bytes, with the
// first and the last among them, and the key moments in addition. Some key moments are dropped if all would
// take more than half of the bytes. The first moment always stays. If there are more grains than
// kMostGrainsOnPage, the page has those that lie nearest to the plane x = 0 when they are first seen. Throws
// DamagedFrame.
PageBed page_bed(const StateArchive& run, std::size_t most_bytes,
                 const PageProgress& progress = kNoPageProgress, const PageContacts& contacts = {});
// The page's frames at these moments. chosen: rising indices of the run's moments.
PageBed page_bed_of(const StateArchive& run, const std::vector<std::size_t>& chosen,
                    const PageProgress& progress = kNoPageProgress, const PageContacts& contacts = {});

// Ratio of the highest to the lowest speed, or force, that a byte can tell. The error of a byte follows from
// it: 2.3 %, as bed_about() (page_parts.cpp) tells the reader.
constexpr double kByteSpan = 1e5;

// The byte that stands for a speed: 0 below `lowest`, else 1 to 254, evenly spaced in its logarithm;
// kUnknownSpeed for NaN.
inline constexpr std::uint8_t kUnknownSpeed = 255;
std::uint8_t speed_byte(double speed, double lowest, double highest);

}  // namespace grainreel
