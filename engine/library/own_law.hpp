// A caller's contact law as the step loop calls it.
#pragma once

#include <exception>
#include <memory>
#include <mutex>

#include "engine/laws/law_kernel.hpp"
#include "engine/library/internal.hpp"
#include "grainreel/contact_law.hpp"

namespace grainreel::v1 {

// A LawKernel that calls one law, a contact at a time. It must outlive all loops that run it.
class OwnLaw {
  public:
    // Throws Error where it wants more memory than there may be.
    explicit OwnLaw(std::shared_ptr<const ContactLaw> law);
    OwnLaw(const OwnLaw&) = delete;
    OwnLaw& operator=(const OwnLaw&) = delete;

    const LawKernel& kernel() const { return kernel_; }
    // Throws what the law has thrown on any thread since the last call.
    void rethrow();

  private:
    struct Kernel : LawKernel {
        OwnLaw* own = nullptr;
    };
    static OwnLaw& of(const LawParameters& parameters);
    static LawParameters parameters_of(const std::vector<PairPlan>& kinds);
    static void step(const LawInput& in, void* history, ForceChunk& out);
    static void step_one_kind(const LawInput& in, void* history, ForceChunk& out);
    static void observe(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy);
    static void step_kinds(const LawInput& in, double* history, ForceChunk& out, bool one_kind);
    void note(std::exception_ptr thrown);

    std::shared_ptr<const ContactLaw> law_;
    int numbers_ = 0, vectors_ = 0;
    Kernel kernel_;
    std::mutex guard_;
    std::exception_ptr thrown_;
};

}  // namespace grainreel::v1
