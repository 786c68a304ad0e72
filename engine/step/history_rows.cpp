#include "engine/step/history_rows.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/step/history_rows.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/vector/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Doubles: four numbers of kLanes rows at a time. The stride is known to the compiler: addresses are computed
// once for all numbers of a row.
template <std::size_t stride>
void bring_rows(const double* rows, const std::int32_t* row, int count, double* chunk) {
    const Doubles d;
    for (int c = 0; c < count; c += kLanes) {
        double* block = chunk + c / kBlock * (stride * kBlock) + c % kBlock;
        for (std::size_t k = 0; k < stride; k += 4) {
            const Four<Doubles> f = load_records(rows + k, stride, row + c);
            hn::Store(f.a, d, block + k * kBlock), hn::Store(f.b, d, block + (k + 1) * kBlock);
            hn::Store(f.c, d, block + (k + 2) * kBlock), hn::Store(f.d, d, block + (k + 3) * kBlock);
        }
    }
}

template <std::size_t stride>
void put_rows(double* rows, const std::int32_t* row, int count, const double* chunk) {
    const Doubles d;
    for (int c = 0; c < count; c += kLanes) {
        const double* block = chunk + c / kBlock * (stride * kBlock) + c % kBlock;
        for (std::size_t k = 0; k < stride; k += 4) {
            const double* from = block + k * kBlock;
            store_records_at<Doubles>({hn::Load(d, from), hn::Load(d, from + kBlock),
                                       hn::Load(d, from + 2 * kBlock), hn::Load(d, from + 3 * kBlock)},
                                      rows + k, stride, row + c);
        }
    }
}

constexpr std::size_t kMost = HistoryRows::kMostNumbers;

template <std::size_t stride = 4>
void bring_doubles(const double* rows, std::size_t wanted, const std::int32_t* row, int count,
                   double* chunk) {
    if (wanted == stride) return bring_rows<stride>(rows, row, count, chunk);
    if constexpr (stride < kMost) bring_doubles<stride + 4>(rows, wanted, row, count, chunk);
}

template <std::size_t stride = 4>
void put_doubles(double* rows, std::size_t wanted, const std::int32_t* row, int count, const double* chunk) {
    if (wanted == stride) return put_rows<stride>(rows, row, count, chunk);
    if constexpr (stride < kMost) put_doubles<stride + 4>(rows, wanted, row, count, chunk);
}

// Floats: four numbers of four rows at a time.
#if HWY_TARGET == HWY_SCALAR
void bring_floats(const float* rows, std::size_t stride, const std::int32_t* row, int count, float* chunk) {
    for (int c = 0; c < count; ++c) {
        float* block = chunk + c / kBlock * (stride * kBlock) + c % kBlock;
        for (std::size_t k = 0; k < stride; ++k) block[k * kBlock] = rows[row[c] * stride + k];
    }
}

void put_floats(float* rows, std::size_t stride, const std::int32_t* row, int count, const float* chunk) {
    for (int c = 0; c < count; ++c) {
        const float* block = chunk + c / kBlock * (stride * kBlock) + c % kBlock;
        for (std::size_t k = 0; k < stride; ++k) rows[row[c] * stride + k] = block[k * kBlock];
    }
}
#else
using FourFloats = hn::FixedTag<float, 4>;

// Four rows of four numbers: columns of them.
HWY_INLINE void transpose(hn::Vec<FourFloats>& a, hn::Vec<FourFloats>& b, hn::Vec<FourFloats>& c,
                          hn::Vec<FourFloats>& d) {
    const FourFloats f;
    const hn::RepartitionToWide<FourFloats> pairs;
    const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(f, a, b));
    const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(f, c, d));
    const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(f, a, b));
    const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(f, c, d));
    a = hn::BitCast(f, hn::InterleaveLower(pairs, low01, low23));
    b = hn::BitCast(f, hn::InterleaveUpper(pairs, low01, low23));
    c = hn::BitCast(f, hn::InterleaveLower(pairs, high01, high23));
    d = hn::BitCast(f, hn::InterleaveUpper(pairs, high01, high23));
}

void bring_floats(const float* rows, std::size_t stride, const std::int32_t* row, int count, float* chunk) {
    const FourFloats f;
    for (int c = 0; c < count; c += 4) {
        float* block = chunk + c / kBlock * (stride * kBlock) + c % kBlock;
        for (std::size_t k = 0; k < stride; k += 4) {
            const auto of = [&](int n) { return hn::Load(f, rows + row[c + n] * stride + k); };
            auto r0 = of(0), r1 = of(1), r2 = of(2), r3 = of(3);
            transpose(r0, r1, r2, r3);
            float* to = block + k * kBlock;
            hn::Store(r0, f, to), hn::Store(r1, f, to + kBlock);
            hn::Store(r2, f, to + 2 * kBlock), hn::Store(r3, f, to + 3 * kBlock);
        }
    }
}

void put_floats(float* rows, std::size_t stride, const std::int32_t* row, int count, const float* chunk) {
    const FourFloats f;
    for (int c = 0; c < count; c += 4) {
        const float* block = chunk + c / kBlock * (stride * kBlock) + c % kBlock;
        for (std::size_t k = 0; k < stride; k += 4) {
            const float* from = block + k * kBlock;
            auto r0 = hn::Load(f, from), r1 = hn::Load(f, from + kBlock);
            auto r2 = hn::Load(f, from + 2 * kBlock), r3 = hn::Load(f, from + 3 * kBlock);
            transpose(r0, r1, r2, r3);
            const auto to = [&](int n) { return rows + row[c + n] * stride + k; };
            hn::Store(r0, f, to(0)), hn::Store(r1, f, to(1));
            hn::Store(r2, f, to(2)), hn::Store(r3, f, to(3));
        }
    }
}
#endif

void bring_all_doubles(const double* rows, std::size_t stride, const std::int32_t* row, int count,
                       double* chunk) {
    bring_doubles(rows, stride, row, count, chunk);
}
void put_all_doubles(double* rows, std::size_t stride, const std::int32_t* row, int count,
                     const double* chunk) {
    put_doubles(rows, stride, row, count, chunk);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(bring_all_doubles);
HWY_EXPORT(put_all_doubles);
HWY_EXPORT(bring_floats);
HWY_EXPORT(put_floats);

void HistoryRows::bring(const std::int32_t* row, int count, Histories& chunk) const {
    const void* rows = lines_.data();
    void* to = chunk.of_block(0);
    if (size_ == sizeof(float)) {
        HWY_DYNAMIC_DISPATCH(bring_floats)
        (static_cast<const float*>(rows), stride_, row, count, static_cast<float*>(to));
    } else {
        HWY_DYNAMIC_DISPATCH(bring_all_doubles)
        (static_cast<const double*>(rows), stride_, row, count, static_cast<double*>(to));
    }
}

void HistoryRows::put_back(const std::int32_t* row, int count, const Histories& chunk) {
    void* rows = lines_.data();
    const void* from = chunk.of_block(0);
    if (size_ == sizeof(float)) {
        HWY_DYNAMIC_DISPATCH(put_floats)
        (static_cast<float*>(rows), stride_, row, count, static_cast<const float*>(from));
    } else {
        HWY_DYNAMIC_DISPATCH(put_all_doubles)
        (static_cast<double*>(rows), stride_, row, count, static_cast<const double*>(from));
    }
}

}  // namespace grainreel
#endif
