// The words that scenes use for choices, once for the reader, the writer and the list of keys.
#pragma once

#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

inline const Words<NormalLaw> normal_law_words{{"walton-braun", NormalLaw::walton_braun},
                                               {"spring-dashpot", NormalLaw::spring_dashpot},
                                               {"hertz", NormalLaw::hertz}};
inline const Words<TangentialLaw> tangential_law_words{{"incremental-slip", TangentialLaw::incremental_slip},
                                                       {"linear-spring", TangentialLaw::linear_spring},
                                                       {"mindlin", TangentialLaw::mindlin},
                                                       {"none", TangentialLaw::none}};
inline const Words<Integrator> integrator_words{{"velocity-verlet", Integrator::velocity_verlet},
                                                {"leapfrog", Integrator::leapfrog},
                                                {"position-verlet", Integrator::position_verlet},
                                                {"forest-ruth", Integrator::forest_ruth},
                                                {"gear", Integrator::gear}};
inline const Words<Precision> precision_words{{"double", Precision::full}, {"mixed", Precision::mixed}};
inline const Words<Accuracy> accuracy_words{
    {"draft", Accuracy::draft}, {"standard", Accuracy::standard}, {"reference", Accuracy::reference}};

inline const Words<FieldOutput::Grid> field_grid_words{
    {"none", FieldOutput::Grid::none}, {"yz", FieldOutput::Grid::yz}, {"xyz", FieldOutput::Grid::xyz}};
inline const Words<FieldOutput::Kernel> field_kernel_words{{"gaussian", FieldOutput::Kernel::gaussian},
                                                           {"lucy", FieldOutput::Kernel::lucy}};

}  // namespace grainreel
