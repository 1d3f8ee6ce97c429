// oil_film_test.cpp — films of journals against Raimondi and Boyd's numbers, Ocvirk's closed form, and by hand in a scene.
#include "studies/forces/oil_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "studies/forces/forces_findings.h"
#include "tests/support/scenes.h"

namespace kurbel::oil_film_test {
namespace {

using std::numbers::pi;

// A. A. Raimondi, J. Boyd, Trans. ASLE 1 (1958), 159–209: full bearing, Sommerfeld number at h_min/c = 1 − ε. Their grids
// and three digits: 1.5 %, at ε = 0.97 3.5 %.
TEST(OilFilm, SommerfeldNumbersAreThoseOfRaimondiAndBoyd) {
  const double eccentricity[] = {0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97};
  const struct {
    double slenderness, number[7];
  } published[] = {{1, {1.33, 0.631, 0.264, 0.121, 0.0446, 0.0188, 0.00474}},
                   {0.5, {4.31, 2.03, 0.779, 0.319, 0.0923, 0.0313, 0.00609}},
                   {0.25, {16.2, 7.57, 2.83, 1.07, 0.261, 0.0736, 0.0101}}};
  for (const auto& bearing : published)
    for (int i = 0; i < 7; ++i) {
      const Estimate w = bearing_load_number(eccentricity[i], bearing.slenderness);
      EXPECT_NEAR(1 / (pi * w.value) / bearing.number[i], 1, i == 6 ? 0.035 : 0.015)
          << "L/D = " << bearing.slenderness << ", ε = " << eccentricity[i];
    }
}

// F. W. Ocvirk, NACA TN 2808 (1952): the limit L/D → 0, W c²/(η U L R²) = (L/D)² ε √(16 ε² + π² (1 − ε²))/(1 − ε²)².
TEST(OilFilm, ShortBearingsAreOcvirks) {
  for (const double e : {0.05, 0.3, 0.6, 0.9}) {
    const double narrow = 0.002, own = 1 - e * e;
    const Estimate w = bearing_load_number(e, narrow);
    const double closed = narrow * narrow * e * std::sqrt(16 * e * e + pi * pi * own) / (own * own);
    EXPECT_NEAR(w.value, closed, *w.error) << e;
    EXPECT_LT(*w.error, 1e-3 * w.value);
  }
}

TEST(OilFilm, LeastFilmInvertsTheLoad) {
  for (const double gap : {0.9, 0.5, 0.1, 0.01}) {
    const Estimate found = least_film(bearing_load_number(1 - gap, 0.7).value, 0.7);
    EXPECT_NEAR(found.value, gap, 2e-4 * gap);
    EXPECT_LT(*found.error, 0.02 * gap);
  }
  EXPECT_EQ(least_film(0, 1).value, 1);
  EXPECT_EQ(least_film(HUGE_VAL, 1).value, 0);
  EXPECT_THROW(bearing_load_number(1, 1), std::invalid_argument);
  EXPECT_THROW(bearing_load_number(0.5, 0), std::invalid_argument);
}

Forces forces_of(const std::string& text) {
  ForcesOptions options;
  options.simulate = false;
  return find_forces(test::scene_from(text), options);
}

std::string crank_with(const std::string& pins) {
  return R"(
line = ["crank"]
[crank]
kind = "slider-crank"
radius = "100 mm"
rod = "300 mm"
slider_mass = "20 kg"
crank_inertia = "1 kg*m2"
)" + pins +
         R"(
[run]
start = { speed = "100 rad/s" }
until = "1 s"
)";
}

TEST(OilFilm, FilmParameterOfAMainBearingIsThatByHand) {
  const Forces f = forces_of(crank_with(
      R"(main_bearing = { radius = "40 mm", roughness = "0.3 um", bore_roughness = "0.4 um", viscosity = "0.02 Pa*s", clearance = "40 um", film_length = "40 mm" }
slider_pin = { radius = "20 mm", roughness = "0.3 um", bore_roughness = "0.4 um", viscosity = "0.02 Pa*s", clearance = "20 um", film_length = "40 mm" })"));
  ASSERT_EQ(f.films.size(), 2u);
  const PinFilm &main = f.films[0], &slider = f.films[1];
  EXPECT_EQ(main.joint, "main bearing");
  EXPECT_DOUBLE_EQ(main.speed, 0.04 * 100);
  EXPECT_NEAR(main.load, std::abs(f.prescribed->reactions.front().peak.value), 1e-4 * main.load);
  const double w = main.load * 40e-6 * 40e-6 / (0.02 * 4 * 0.04 * 0.04 * 0.04);
  EXPECT_NEAR(bearing_load_number(1 - main.film.value / 40e-6, 0.5).value, w, 2e-3 * w);
  EXPECT_NEAR(main.parameter.value, main.film.value / 0.5e-6, 1e-12 * main.parameter.value);  // √(0.3² + 0.4²) = 0.5
  // The rod turns back against the slider where it is at rest: no film there, but elsewhere.
  EXPECT_LT(slider.parameter.value, 0.1);
  EXPECT_GT(slider.boundary, 0);
  EXPECT_LT(slider.boundary + slider.mixed, 1);
  const Findings reported = findings_of(f);
  EXPECT_TRUE(std::any_of(reported.figures.begin(), reported.figures.end(), [&](const KeyFigure& k) {
    return k.means == "film_parameter" && k.value == main.parameter.value;
  }));
}

TEST(OilFilm, MoreOilOrLessRoughnessMakesItFluidAndNoneDry) {
  const auto main_of = [](const std::string& data) {
    return forces_of(crank_with("main_bearing = { radius = \"40 mm\", " + data + " }"));
  };
  const std::string rest = R"(clearance = "40 um", film_length = "40 mm")";
  const Forces thick = main_of(R"(roughness = "0.1 um", viscosity = "1 Pa*s", )" + rest);
  EXPECT_EQ(thick.films.at(0).words(), "fluid");
  const Forces thin = main_of(R"(roughness = "5 um", viscosity = "1 mPa*s", )" + rest);
  EXPECT_LT(thin.films.at(0).parameter.value, boundary_below);
  EXPECT_GT(thin.films.at(0).boundary, 0.95);  // the rest is where the load passes through nearly nothing
  EXPECT_EQ(main_of(R"(roughness = "5 um", viscosity = "0 Pa*s")").films.at(0).words(), "dry");
}

// The shaft and the crank pin turn, the slider's pin rocks.
TEST(OilFilm, CompressorsPinsAreReportedByWhatIsInTheirScene) {
  const Forces f = find_forces(test::scene_file("scenes/compressor.toml"), {});
  ASSERT_EQ(f.films.size(), 3u);
  EXPECT_EQ(f.films[0].words(), "fluid");
  EXPECT_EQ(f.films[1].words(), "fluid");
  EXPECT_EQ(f.films[2].words(), "boundary, mixed, fluid");
  EXPECT_NEAR(f.films[2].speed, 0, 1e-3);
}

}  // namespace
}  // namespace kurbel::oil_film_test
