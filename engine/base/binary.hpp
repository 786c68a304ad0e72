// Plain values and vectors to and from a binary stream, in this machine's byte order.
#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <type_traits>
#include <vector>

namespace grainreel {

template <class T>
void write_value(std::ostream& out, const T& value) {
    static_assert(std::is_trivially_destructible_v<T>);
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
void read_value(std::istream& in, T& value) {
    static_assert(std::is_trivially_destructible_v<T>);
    in.read(reinterpret_cast<char*>(&value), sizeof value);
}

template <class T, class Memory>
void write_vector(std::ostream& out, const std::vector<T, Memory>& values) {
    static_assert(std::is_trivially_destructible_v<T>);
    write_value(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

// Sets the stream's failbit instead of taking in more than 2^31 entries, which only a damaged file asks for.
template <class T, class Memory>
void read_vector(std::istream& in, std::vector<T, Memory>& values) {
    std::uint64_t size = 0;
    read_value(in, size);
    if (!in || size > (std::uint64_t{1} << 31)) return in.setstate(std::ios::failbit);
    values.resize(size);
    in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(size * sizeof(T)));
}

// For functions that name what is saved once, and serve both ways.
struct Writing {
    std::ostream& out;
    template <class T>
    void operator()(const T& value) const {
        write_value(out, value);
    }
    template <class T, class Memory>
    void operator()(const std::vector<T, Memory>& values) const {
        write_vector(out, values);
    }
};
struct Reading {
    std::istream& in;
    template <class T>
    void operator()(T& value) const {
        read_value(in, value);
    }
    template <class T, class Memory>
    void operator()(std::vector<T, Memory>& values) const {
        read_vector(in, values);
    }
};

}  // namespace grainreel
