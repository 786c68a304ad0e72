// Writes plain values and vectors as bytes and reads them back, in this machine's byte order. Checkpoints and
// caches use it.
#pragma once

#include <cstdint>
#include <cstring>
#include <ostream>
#include <string_view>
#include <type_traits>
#include <vector>

namespace grainreel {

template <class T>
void write_value(std::ostream& out, const T& value) {
    static_assert(std::is_trivially_destructible_v<T>);
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T, class Memory>
void write_vector(std::ostream& out, const std::vector<T, Memory>& values) {
    static_assert(std::is_trivially_destructible_v<T>);
    write_value(out, static_cast<std::uint64_t>(values.size()));
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

// The bytes of a file, read from the front. If a size in the file is larger than the rest of the file,
// reading fails before memory is asked for.
class Bytes {
  public:
    explicit Bytes(std::string_view all) : left_(all) {}

    bool failed() const { return failed_; }
    void fail() { failed_ = true; }
    std::size_t left() const { return left_.size(); }

    void read(void* to, std::size_t size) {
        if (size > left_.size()) failed_ = true;
        if (failed_) return;
        if (size > 0) std::memcpy(to, left_.data(), size);
        left_.remove_prefix(size);
    }

  private:
    std::string_view left_;
    bool failed_ = false;
};

template <class T>
void read_value(Bytes& in, T& value) {
    static_assert(std::is_trivially_destructible_v<T>);
    in.read(reinterpret_cast<char*>(&value), sizeof value);
}

template <class T, class Memory>
void read_vector(Bytes& in, std::vector<T, Memory>& values) {
    std::uint64_t size = 0;
    read_value(in, size);
    if (size > in.left() / sizeof(T)) in.fail();
    if (in.failed()) return;
    values.resize(size);
    in.read(reinterpret_cast<char*>(values.data()), size * sizeof(T));
}

// Two functions with one form, so that a list of saved members is written once and serves for writing and
// reading.
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
    Bytes& in;
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
