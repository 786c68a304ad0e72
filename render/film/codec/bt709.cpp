#include "render/film/codec/bt709.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/film/codec/bt709.cpp"
#include "engine/vector/targets.hpp"
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Pixels = hn::ScalableTag<std::uint32_t>;  // one pixel in each lane, red in the lowest byte
using OnePixel = hn::CappedTag<std::uint32_t, 1>;

constexpr int kBits = 16;  // bits of a share's fraction

// How a code is computed: the shares of the three colours (219 or 224 codes stand for 255 levels), and the
// code `zero` of black or grey.
struct Share {
    int red, green, blue, zero;
};
constexpr int fixed(double share) {
    return static_cast<int>(share * (1 << kBits) + (share < 0 ? -0.5 : 0.5));
}
constexpr double kRed = 0.2126, kGreen = 0.7152, kBlue = 0.0722;
constexpr double kY = 219.0 / 255, kCb = 224.0 / 255 / 1.8556, kCr = 224.0 / 255 / 1.5748;
constexpr Share kLuma{fixed(kY * kRed), fixed(kY* kGreen), fixed(kY* kBlue), 16};
constexpr Share kToBlue{fixed(-kCb * kRed), fixed(-kCb* kGreen), fixed(kCb*(1 - kBlue)), 128};
constexpr Share kToRed{fixed(kCr * (1 - kRed)), fixed(-kCr* kGreen), fixed(-kCr* kBlue), 128};

template <class D>
using Numbers = hn::Vec<hn::RebindToSigned<D>>;
template <class D>
struct Colours {
    Numbers<D> red, green, blue;
};

template <class D>
HWY_INLINE hn::Vec<D> pixels_at(D d, const std::uint8_t* at) {
    return hn::LoadU(d, reinterpret_cast<const std::uint32_t*>(at));
}

// Turns sums of 2^bits pixels into codes and stores them as bytes.
template <int bits, class D>
HWY_INLINE void store_codes(const Share& share, const Colours<D>& sum, std::uint8_t* to) {
    const hn::RebindToSigned<D> numbers;
    constexpr int shift = kBits + bits;
    const auto rest = hn::Set(numbers, (share.zero << shift) + (1 << (shift - 1)));
    const auto red = hn::Mul(sum.red, hn::Set(numbers, share.red));
    const auto green = hn::Mul(sum.green, hn::Set(numbers, share.green));
    const auto blue = hn::Mul(sum.blue, hn::Set(numbers, share.blue));
    const auto code = hn::ShiftRight<shift>(hn::Add(hn::Add(red, green), hn::Add(blue, rest)));
    const hn::Rebind<std::uint8_t, D> codes;
    hn::StoreU(hn::DemoteTo(codes, code), codes, to);
}

template <class D>
HWY_INLINE void luma(D d, const std::uint8_t* pixels, std::uint8_t* to) {
    const hn::RebindToSigned<D> numbers;
    const auto low = hn::Set(d, 0xffu);
    const auto all = pixels_at(d, pixels);
    const auto colour = [&](auto shifted) { return hn::BitCast(numbers, hn::And(shifted, low)); };
    store_codes<0>(
        kLuma, Colours<D>{colour(all), colour(hn::ShiftRight<8>(all)), colour(hn::ShiftRight<16>(all))}, to);
}

// The columns from `begin` to `end` - 1.
struct Columns {
    int begin, end;
};

void luma_row(const std::uint8_t* pixels, const Columns& columns, std::uint8_t* to) {
    const Pixels d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    int x = columns.begin;
    for (; x + lanes <= columns.end; x += lanes) {
        // Another processor core has just drawn the pixels, so they come slowly. Fetching them early saves a
        // fifth of the time.
        hwy::Prefetch(pixels + 4 * (x + 512));
        luma(d, pixels + 4 * x, to + x);
    }
    for (; x < columns.end; ++x) luma(OnePixel(), pixels + 4 * x, to + x);
}

// Sums of pixels with 16 bits for each colour: red and blue share a lane, green has its own.
template <class D>
struct Halves {
    hn::Vec<D> red_blue, green;
};

template <class D>
HWY_INLINE Halves<D> halves(D d, const std::uint8_t* upper, const std::uint8_t* lower) {
    const auto low = hn::Set(d, 0x00ff00ffu);
    const auto a = pixels_at(d, upper), b = pixels_at(d, lower);
    // Each colour has 16 bits, so a sum never runs over into the next colour.
    return {hn::Add(hn::And(a, low), hn::And(b, low)),
            hn::Add(hn::And(hn::ShiftRight<8>(a), low), hn::And(hn::ShiftRight<8>(b), low))};
}

template <class D>
HWY_INLINE Halves<D> sum(Halves<D> a, Halves<D> b) {
    return {hn::Add(a.red_blue, b.red_blue), hn::Add(a.green, b.green)};
}

template <class D>
HWY_INLINE void chroma(D d, const Halves<D>& sums, std::uint8_t* cb, std::uint8_t* cr) {
    const hn::RebindToSigned<D> numbers;
    const auto low = hn::Set(d, 0xffffu);
    const Colours<D> eight{hn::BitCast(numbers, hn::And(sums.red_blue, low)),
                           hn::BitCast(numbers, hn::And(sums.green, low)),
                           hn::BitCast(numbers, hn::ShiftRight<16>(sums.red_blue))};
    store_codes<3>(kToBlue, eight, cb);
    store_codes<3>(kToRed, eight, cr);
}

struct RowPair {
    const std::uint8_t *upper, *lower;
};

#if HWY_TARGET != HWY_SCALAR
// Sums every other column from `x` on with the columns beside it. Two registers of pixels give one register
// of sums.
HWY_INLINE Halves<Pixels> every_other(const RowPair& rows, int x) {
    const Pixels d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const auto columns = [&](int from) { return halves(d, rows.upper + 4 * from, rows.lower + 4 * from); };
    const auto even = [&](Halves<Pixels> low, Halves<Pixels> high) {
        return Halves<Pixels>{hn::ConcatEven(d, high.red_blue, low.red_blue),
                              hn::ConcatEven(d, high.green, low.green)};
    };
    const auto odd = [&](Halves<Pixels> low, Halves<Pixels> high) {
        return Halves<Pixels>{hn::ConcatOdd(d, high.red_blue, low.red_blue),
                              hn::ConcatOdd(d, high.green, low.green)};
    };
    const Halves<Pixels> low = columns(x), high = columns(x + lanes);
    const Halves<Pixels> middle = even(low, high), left = even(columns(x - 1), columns(x - 1 + lanes));
    return sum(sum(middle, middle), sum(left, odd(low, high)));
}
#endif

void chroma_row(const RowPair& rows, const Columns& columns, std::uint8_t* cb, std::uint8_t* cr) {
    const auto one = [&](int x) {
        const OnePixel single;
        const auto column = [&](int at) { return halves(single, rows.upper + 4 * at, rows.lower + 4 * at); };
        const Halves<OnePixel> middle = column(x);
        const Halves<OnePixel> sums =
            sum(sum(middle, middle), sum(column(std::max(x - 1, 0)), column(x + 1)));
        chroma(single, sums, cb + x / 2, cr + x / 2);
    };
    int x = columns.begin;
    if (x == 0) one(x), x = 2;
#if HWY_TARGET != HWY_SCALAR
    const int step = 2 * static_cast<int>(hn::Lanes(Pixels()));
    for (; x + step <= columns.end; x += step) chroma(Pixels(), every_other(rows, x), cb + x / 2, cr + x / 2);
#endif
    for (; x < columns.end; x += 2) one(x);
}

// Converts `part`, which begins and ends with even columns and rows.
void convert(const Picture& picture, const Rectangle& part, const YuvPlanes& to) {
    const Columns columns{part.x, part.x + part.width};
    for (int y = part.y; y < part.y + part.height; y += 2) {
        const RowPair rows{picture.pixel(0, y), picture.pixel(0, y + 1)};
        luma_row(rows.upper, columns, to.y + y * to.y_stride);
        luma_row(rows.lower, columns, to.y + (y + 1) * to.y_stride);
        chroma_row(rows, columns, to.cb + y / 2 * to.cb_stride, to.cr + y / 2 * to.cr_stride);
    }
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "engine/base/error.hpp"

namespace grainreel {

HWY_EXPORT(convert);

void to_bt709(const Picture& picture, const YuvPlanes& to) {
    to_bt709(picture, {0, 0, picture.width, picture.height}, to);
}

void to_bt709(const Picture& picture, const Rectangle& part, const YuvPlanes& to) {
    GRAINREEL_CHECK(picture.width > 0 && picture.width % 2 == 0 && picture.height % 2 == 0);
    const auto even = [](int at) { return at / 2 * 2; };
    const int x = even(std::max(part.x, 0)), y = even(std::max(part.y, 0));
    // The chroma of the column to the right of the part also depends on the part's last column.
    const int right = std::min(even(part.x + part.width + 2), picture.width);
    const int bottom = std::min(even(part.y + part.height + 1), picture.height);
    if (x < right && y < bottom) HWY_DYNAMIC_DISPATCH(convert)(picture, {x, y, right - x, bottom - y}, to);
}

}  // namespace grainreel
#endif
