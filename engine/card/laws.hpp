// The laws that have kernels on a card: X(normal, tangential, types of both), with the names that
// ContactModel (engine/plan/plan.hpp) and engine/laws have. list-inl.hpp lists the same for the processor.
#pragma once

#include "engine/laws/friction-inl.hpp"
#include "engine/laws/hertz-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/linear_spring-inl.hpp"
#include "engine/laws/mindlin-inl.hpp"
#include "engine/laws/spring_dashpot-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "engine/laws/walton_braun_corrected-inl.hpp"
#include "engine/laws/walton_braun_speed-inl.hpp"

#define GRAINREEL_CARD_LINEAR_LAWS(X, normal, Normal)    \
    X(normal, incremental_slip, Normal, IncrementalSlip) \
    X(normal, linear_spring, Normal, LinearSpring)       \
    X(normal, none, Normal, Frictionless)

#define GRAINREEL_CARD_LAWS(X)                                                  \
    GRAINREEL_CARD_LINEAR_LAWS(X, walton_braun, WaltonBraun)                    \
    GRAINREEL_CARD_LINEAR_LAWS(X, walton_braun_corrected, WaltonBraunCorrected) \
    GRAINREEL_CARD_LINEAR_LAWS(X, walton_braun_speed, WaltonBraunSpeed)         \
    GRAINREEL_CARD_LINEAR_LAWS(X, walton_braun_table, WaltonBraunTable)         \
    GRAINREEL_CARD_LINEAR_LAWS(X, spring_dashpot, SpringDashpot)                \
    X(hertz, mindlin, Hertz, Mindlin)                                           \
    X(hertz, none, Hertz, Frictionless)
