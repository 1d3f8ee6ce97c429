// symbols.h — symbols of formulas, diagrams and worksheets, as they are written there: "R_12", "aⁿ_BA", "μ_v".
//
// A star stands for an index. A symbol with several meanings has all of them.
#pragma once

#include "studies/dictionary/entries.h"

namespace kurbel::entries {

inline constexpr std::string_view on_sheets = "reduce, forces (--sheet)";

inline constexpr Definition of_symbols[] = {
    // position and motion
    {"φ", "angle of the crank or of the reduction link", "rad", "", "9", on_sheets,
     "from +x, counter-clockwise; on a sheet in degrees; in a mode's energies the amplitude of an inertia's angle"},
    {"x", "way of a mechanism's output", "m", "", "9", on_sheets,
     "position of the output along +x; with a wheel of a gear pair its profile shift in modules"},
    {"ψ", "angle of a mechanism's output", "rad", "", "9", on_sheets, "of an output that rocks, counter-clockwise"},
    {"s", "way from position 0", "m", "", "9", on_sheets, "of the output, x − x(0)"},
    {"s_*", "centre of mass", "m", "", "9", on_sheets,
     "in formulas its distance from the link's first joint; small in a plan: the point of the link's centre of mass"},
    {"x′", "way by angle", "m/rad", "", "9", on_sheets, "dx/dφ, the analogue of velocity: v = x′ ω"},
    {"x″", "its second derivative by angle", "m/rad2", "", "9", on_sheets,
     "d²x/dφ², the analogue of acceleration: a = x″ ω² + x′ ε"},
    {"ψ′", "angle of the output by angle", "", "", "9", on_sheets, "dψ/dφ"},
    {"ψ″", "its second derivative", "", "", "9", on_sheets, "d²ψ/dφ²"},
    {"ψ̇", "angular velocity of the output", "rad/s", "", "9", on_sheets, "dψ/dt"},
    {"ψ̈", "angular acceleration of the output", "rad/s2", "", "9", on_sheets, "d²ψ/dt²"},
    {"v", "velocity", "m/s", "", "9", on_sheets, "of the output; with an index of that point, of a rim its speed"},
    {"v_*", "velocity of a point", "m/s", "", "9", on_sheets,
     "of one letter the magnitude of the point's velocity; v_BA that of B against A of the same link, across BA; v_AA3 "
     "that "
     "of a slide's point A against the point of link 3 that it covers, along the slide; v_m of a rim's mean radius; "
     "v_g "
     "sliding speed of flanks"},
    {"a", "acceleration", "m/s2", "", "9", on_sheets,
     "of the output; in Wittenbauer's method ½ ω_max²; small in a plan: the point of the pin A"},
    {"a_*", "acceleration of a point", "m/s2", "", "9", on_sheets,
     "its magnitude; a_w and a of gears are centre distances; small in a plan: the point of a link"},
    {"aⁿ_*", "normal acceleration", "m/s2", "", "9", on_sheets, "ω² times the distance, towards the other point"},
    {"aᵗ_*", "tangential acceleration", "m/s2", "", "9", on_sheets, "ε times the distance, across it"},
    {"aᶜ_*", "Coriolis acceleration", "m/s2", "", "9", on_sheets,
     "2 ω times the velocity along a slide that turns with ω, across the slide"},
    {"aʳ_*", "relative acceleration", "m/s2", "", "9", on_sheets, "along a slide, of its point against the link below"},
    {"p_v", "pole of velocities", "", "", "9", on_sheets,
     "the point of the plan that has no velocity: vectors from it are velocities in the frame"},
    {"p_a", "pole of accelerations", "", "", "9", on_sheets, "the point of the plan that has no acceleration"},
    {"ω", "angular velocity", "rad/s", "", "2", on_sheets,
     "of the crank, the reduction link or, in modes, of a vibration"},
    {"ω_*", "angular velocity of a link or its extreme", "rad/s", "", "2", on_sheets,
     "with a number that of the link; ω_max, ω_min greatest and least of a cycle, ω_mid the middle of both"},
    {"ε", "angular acceleration", "rad/s2", "", "2", on_sheets, "dω/dt"},
    {"ε_*", "angular acceleration of a link, or a contact ratio", "", "", "6", "reduce, forces (--sheet), gears",
     "with a number that of the link in rad/s²; ε_α, ε_β, ε_γ: transverse, overlap and total contact ratio"},
    // forces
    {"F", "load on the output", "N", "", "9", on_sheets,
     "of a mechanism, positive along +x; of a rocking one a torque"},
    {"F_*", "force on a link", "N", "", "9.6", on_sheets,
     "F_2: inertia force −m a_S of link 2, F_x2 and F_y2 its parts along +x and +y; F_a: a spring or force within the "
     "linkage"},
    {"G_*", "weight of a link", "N", "", "9.6", on_sheets, "m g, downwards, in the centre of mass"},
    {"R_*", "reaction in a joint", "N", "", "9.6", on_sheets,
     "R_12: of link 1 on link 2, the opposite of R_21; the frame is 0; R_m of a rim its mean radius"},
    {"T_*", "friction along a slide", "N", "", "10", on_sheets, "numbered as the slide's reaction, R_"},
    {"α_*", "an angle", "rad", "", "9", "forces (--sheet), gears",
     "with links' numbers the direction of the reaction R_ from +x; α_n, α_t, α_wt pressure angles of gears: normal, "
     "transverse, working"},
    {"M", "torque", "N*m", "", "2", on_sheets, "of the shaft on the crank, or of a load"},
    {"M_b", "balancing torque", "N*m", "", "9.7", "forces",
     "of the shaft on the crank, so that the links move as they do"},
    {"M_d", "driving torque", "N*m", "", "2.2", on_sheets, "of the drive, reduced to the link"},
    {"M_c", "resisting torque", "N*m", "", "2.2", on_sheets,
     "of the loads, reduced to the link, positive against the motion"},
    {"M_*", "a torque", "N*m", "", "2", on_sheets,
     "M_2: couple −I ε of link 2; M_load: load on a rocking output; M_r: reduced; M_g: of the weights on the crank"},
    {"P", "power", "W", "", "2", "size, forces", "mean power of the work; P_f what joint friction takes"},
    {"P_*", "power", "W", "", "8", "forces", "P_f: what the friction of the joints takes"},
    {"f", "coefficient of friction of a pin", "", "", "8.4", "forces", "friction over normal force"},
    {"m_*", "mass, or a module", "kg", "", "9", "forces, gears",
     "of a link; m_n, m_t normal and transverse module of gears"},
    {"m", "module", "m", "", "6", "gears", "reference diameter over the number of teeth"},
    {"U_*", "unbalance", "kg*m", "", "9.11", "forces", "mass times radius that rotates with the crank"},
    {"c", "distance of the rod's centre of mass", "m", "", "9.11", "forces", "from the crank pin"},
    {"l", "length of the rod", "m", "", "9.11", "forces",
     "on the energy–mass sheet: where the lower tangent meets the axis"},
    {"r", "radius", "m", "", "9", "forces", "of the crank, or of a pin"},
    {"r_*", "radius", "m", "", "6", "gears", "r_b base circle"},
    {"η", "efficiency", "", "", "9", "forces, gears", "useful work over the work spent; η′ with the power going back"},
    {"η′", "efficiency with the wheel driving", "", "", "6.15", "gears", "negative: the worm locks itself"},
    // inertia, works, flywheel
    {"I_r", "reduced inertia", "kg*m2", "", "2.1", on_sheets, "of the whole machine on the reduction link"},
    {"I_r′", "slope of the reduced inertia", "kg*m2", "", "2.1", on_sheets, "dI_r/dφ"},
    {"I_em", "reduced inertia of the mechanisms", "kg*m2", "", "2.1", on_sheets, "the part of I_r that depends on φ"},
    {"I_0", "constant inertia on the link", "kg*m2", "", "3.2", "size, reduce", "that keeps δ at what is demanded"},
    {"I_*", "moment of inertia", "kg*m2", "", "3", "size, reduce",
     "of what the index names: flywheel, drive, motor, rim"},
    {"I", "moment of inertia", "kg*m2", "", "3", "size", "of the machine or of the flywheel"},
    {"J", "moment of inertia", "kg*m2", "", "12", "modes", "of an inertia of the chain, reduced"},
    {"A_*", "work", "J", "", "3", on_sheets, "A_d of the drive, A_c of the loads; A_useful, A_in of a cycle"},
    {"ΔA_*", "greatest fluctuation of energy", "J", "", "3.4", "size", "max ΔT − min ΔT"},
    {"ΔT", "change of kinetic energy", "J", "", "3", on_sheets, "A_d − A_c from position 0 on"},
    {"ΔT_*", "ΔT less that of the mechanisms", "J", "", "3.3", "size", "ΔT − ½ ω_mid² I_em"},
    {"ΔE", "energy that the flywheel gives", "J", "", "3.5", "size", "while the tool works, E (1 − t_w/t_c)"},
    {"E", "energy of a stroke", "J", "", "3.5", "size",
     "work of the load in a cycle; as a letter of the path of contact its end"},
    {"t_*", "time", "s", "", "3.5", "size", "t_w of work, t_c of a cycle"},
    {"T", "kinetic energy", "J", "", "2", "size, forces", "½ I ω²"},
    {"Φ", "angle of a cycle", "rad", "", "2.3", "size", "after which all comes again"},
    {"ψ_*", "angle of a tangent", "rad", "", "3.2", on_sheets,
     "of the energy–mass curve on paper: tan ψ = ½ ω² μ_I/μ_T at the greatest or the least speed"},
    {"k", "stiffness", "N*m/rad", "", "12", "modes, gears",
     "of an elastic part; on the energy–mass sheet: where the upper tangent meets the axis"},
    {"kl", "intercept of the tangents", "", "", "3.2", on_sheets, "on the axis of ΔT: I₀ = kl μ_T/(ω_mid² δ)"},
    {"D", "diameter of the rim", "m", "", "3.7", "size", "outer"},
    {"h", "height of the rim", "m", "", "3.7", "size", "radial"},
    {"b", "width", "m", "", "3.7", "size, gears",
     "of a rim or of teeth; in Wittenbauer's method ½ ω_min²; small in a plan: the point of the pin B"},
    {"n", "number of spokes", "", "", "3.7", "size", "of a rim"},
    {"σ", "stress of the rim", "Pa", "", "3.7", "size", "ring stress with bending between the spokes"},
    {"τ_*", "torque in an elastic part", "N*m", "", "14.2", "compare, run", "of the elastic or of the rigid model"},
    {"K", "torque amplification", "", "", "14.2", "compare, run",
     "greatest torque of the elastic over that of the rigid model"},
    {"θ", "twist", "rad", "", "12.4", "modes", "of an elastic part"},
    // gears
    {"z", "number of teeth", "", "", "6", "gears", "of a wheel; internal < 0"},
    {"z_*", "number of teeth", "", "", "6", "gears", "of wheel 1 or 2; of a worm its starts"},
    {"x_*", "profile shift", "", "", "6", "gears", "in modules; x_E as it is cut, x_min without undercut"},
    {"h_*", "height of the basic rack", "", "", "6", "gears",
     "in modules: h_f* dedendum, h_Ff* down to which its flank is straight"},
    {"ρ", "radius of the friction circle", "m", "", "8.4", "forces, size",
     "r sin(atan f); of a rim the density; of gears a curvature"},
    {"ρ_*", "radius of curvature", "m", "", "6", "gears",
     "of a flank in contact; ρ_f* of the rack's rounding, in modules"},
    {"ρ′", "friction angle of the flanks", "rad", "", "6.15", "gears", "atan(μ/cos α_n)"},
    {"ζ_*", "specific sliding", "", "", "6.11", "gears", "sliding speed over the speed of the contact along the flank"},
    {"g_*", "place on the path of contact", "m", "", "6.9", "gears", "from the pitch point; A begin, E end"},
    {"c_*", "mesh stiffness", "", "", "6.13", "gears", "c_γα mean along the path, per width"},
    {"c′", "stiffness of one pair of teeth", "", "", "6.13", "gears", "per width"},
    {"u", "gear ratio", "", "", "6", "gears", "z₂/z₁"},
    {"β", "helix angle", "rad", "", "6", "gears", "on the reference cylinder"},
    {"γ", "lead angle", "rad", "", "6.15", "gears", "of the worm"},
    {"d_*", "diameter", "m", "", "6", "gears", "d reference, d_b base, d_a tip, d_f root, d_w working"},
    {"δ_*", "angle of a pitch cone", "rad", "", "6.14", "gears", "of a bevel wheel"},
    {"Σ", "sum, or the angle between shafts", "rad", "", "6.14", "gears", "of a bevel pair; else a sum"},
    {"μ", "coefficient of friction", "", "", "6.15", "gears", "of the flanks"},
    {"d", "diameter", "m", "", "6", "gears", "reference diameter; small in a plan: the point of the pin D"},
    // drawn to scale
    {"e", "offset of a slider-crank", "m", "", "9", on_sheets,
     "of the crank's axis from the guide; small in a plan: the point of the pin E"},
    {"*′", "point of a plan of accelerations", "", "", "9", on_sheets, "of the pin with that letter"},
    {"μ_*", "scale of a drawing", "", "", "9", on_sheets,
     "what a millimetre of the paper stands for: μ_l of lengths, μ_v, μ_a, μ_F, μ_M of velocities, accelerations, "
     "forces, "
     "torques, μ_φ, μ_s of angles and ways, μ_A, μ_T, μ_I of works, energies, inertias"},
};

// What a page calls a figure beside its words: a beginning, an end, and the figure's name.
struct Label {
  std::string_view begin, end, name;
};
inline constexpr Label labels[] = {
    {"largest reaction of ", "", "reaction"},
    {"largest ", ", moment", "reaction_moment"},
    {"largest amplitude at ", "", "largest_swing"},
    {"amplitude at ", "", "spot_swing"},
    {"mode ", "", "natural_frequency"},
    {"without ", "", "change_without"},
    {"with ", "", "change_with"},
    {"flywheel that meets δ", "", "flywheel_that_meets"},
    {"flywheel with the ", "slope", "flywheel_with_slope"},
    {"δ at the ", "", "delta_reached"},
    {"left of a deviation after a cycle", "", "largest_multiplier"},
};

}  // namespace kurbel::entries
