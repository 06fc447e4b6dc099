// Photometric files of every format, type and symmetry, written here with known intensities; and
// damaged ones.
#include "io/light/photometric_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "io/light/polar_curve.h"
#include "tests/support/damaged_files.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::kPi;
using radiosity::PhotometricWeb;
using radiosity::Photometry;
using radiosity::Vec3;

/// Candela by vertical and horizontal angle, degrees.
using Candela = std::function<double(double, double)>;

std::vector<double> steps(double from, double to, double step) {
  std::vector<double> values;
  for (double value = from; value <= to + 1e-9; value += step) values.push_back(value);
  return values;
}

std::string row(const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k) {
    text += fmt::format("{}{}", values[k], k % 10 == 9 ? "\n" : " ");
  }
  return text + "\n";
}

struct Ies {
  std::string head = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] Nobody\n[LUMINAIRE] A lamp\n";
  std::string tilt = "TILT=NONE\n";
  std::string lamps = "1 1000 1";
  int type = 1;
  std::string opening = "2 0.6 1.2 0";
  std::string ballast = "1 1 25";
  std::vector<double> vertical = steps(0, 180, 15);
  std::vector<double> horizontal = {0};
  Candela candela = [](double, double) { return 100.0; };
  std::string tail;

  [[nodiscard]] std::string text() const {
    std::string result = head + tilt + lamps +
                         fmt::format(" {} {} {} ", vertical.size(), horizontal.size(), type) +
                         opening + "\n" + ballast + "\n" + row(vertical) + row(horizontal);
    for (const double plane : horizontal) {
      std::vector<double> values;
      for (const double angle : vertical) values.push_back(candela(angle, plane));
      result += row(values);
    }
    return result + tail;
  }
};

/// Planes from 0 by 360 / n_planes; `planes` are those that intensities are given of.
struct Ldt {
  int symmetry = 0;
  std::vector<double> all = steps(0, 345, 15);
  std::vector<double> given = steps(0, 345, 15);
  std::vector<double> vertical = steps(0, 180, 15);
  std::string lamps = "1\nT5\n2000\n3000\n80\n25\n";
  std::string opening = "1200\n600\n50\n1150\n550\n0\n0\n0\n0\n";
  std::string factor = "1";
  double lumens = 2000;
  Candela candela = [](double, double) { return 100.0; };

  [[nodiscard]] std::string text() const {
    std::string result =
        fmt::format("Nobody\n1\n{}\n{}\n15\n{}\n15\n", symmetry, all.size(), vertical.size());
    result += "report 1\nA lamp\n42\nlamp.ldt\ntoday\n" + opening + "100\n100\n" + factor +
              "\n0\n1\n" + lamps;
    for (int k = 0; k < 10; ++k) result += "0.5\n";
    for (const double plane : all) result += fmt::format("{}\n", plane);
    for (const double angle : vertical) result += fmt::format("{}\n", angle);
    for (const double plane : given) {
      for (const double angle : vertical) {
        result += fmt::format("{}\n", 1000 / lumens * candela(angle, plane));
      }
    }
    return result;
  }
};

/// Towards γ and C, degrees.
Vec3 towards(double gamma, double plane) {
  const double g = gamma * kPi / 180;
  const double c = plane * kPi / 180;
  return {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
}

double sine(double degrees) { return std::sin(degrees * kPi / 180); }
double cosine(double degrees) { return std::cos(degrees * kPi / 180); }

/// No symmetry, to one plane, the other, both: 1 + a term each.
double none(double gamma, double plane) {
  return 100 + sine(gamma) * (20 * cosine(plane) + 30 * sine(plane) + 10 * sine(2 * plane));
}
double to_c0(double gamma, double plane) {
  return 100 + sine(gamma) * (20 * cosine(plane) + 9 * cosine(2 * plane));
}
double to_c90(double gamma, double plane) {
  return 100 + sine(gamma) * (30 * sine(plane) + 9 * cosine(2 * plane));
}
double to_both(double gamma, double plane) { return 100 + 40 * sine(gamma) * cosine(2 * plane); }

class PhotometricFiles : public ScratchFiles {
 protected:
  [[nodiscard]] Photometry read(const std::string& name, const std::string& text) const {
    return io::read_photometric_file(file(name, text));
  }
  /// Holds a web against candela at all its nodes and between them.
  static void expect_web(const PhotometricWeb& web, const Candela& candela) {
    for (double gamma = 0; gamma <= 180; gamma += 15) {
      for (double plane = 0; plane < 360; plane += 15) {
        const double here = candela(gamma, plane);
        EXPECT_NEAR(intensity(web, towards(gamma, plane)), here, 1e-9) << gamma << ' ' << plane;
        if (gamma == 0 || gamma == 180) continue;
        const double between = 0.25 * here + 0.75 * candela(gamma, plane + 15);
        EXPECT_NEAR(intensity(web, towards(gamma, plane + 11.25)), between, 1e-9);
      }
    }
  }
  void expect_refusal(const std::string& name, const std::string& text,
                      const std::string& part) const {
    const std::string message = radiosity::test::refusal<radiosity::SceneError>(
        file(name, text), [](const auto& path) { (void)io::read_photometric_file(path); });
    EXPECT_CONTAINS(message, part);
  }
};

TEST_F(PhotometricFiles, OfIesHaveTheirSymmetry) {
  struct Sample {
    std::vector<double> horizontal;
    Candela candela;
    bool across_c0;
    bool across_c90;
  };
  const std::vector<Sample> cases = {{steps(0, 360, 15), none, false, false},
                                     {steps(0, 180, 15), to_c0, true, false},
                                     {steps(90, 270, 15), to_c90, false, true},
                                     {steps(0, 90, 15), to_both, true, true}};
  for (const Sample& sample : cases) {
    Ies ies;
    ies.horizontal = sample.horizontal;
    ies.candela = sample.candela;
    const Photometry photometry = read("a.ies", ies.text());
    expect_web(photometry.web, sample.candela);
    const radiosity::WebSymmetry symmetry = symmetry_of(photometry.web);
    EXPECT_FALSE(symmetry.is_rotational);
    EXPECT_EQ(symmetry.across_c0, sample.across_c0);
    EXPECT_EQ(symmetry.across_c90, sample.across_c90);
    EXPECT_TRUE(photometry.warnings.empty() ||
                photometry.warnings[0].find("lm") != std::string::npos);
  }
  Ies open;  // the plane of 360 left out
  open.horizontal = steps(0, 345, 15);
  open.candela = none;
  const Photometry closed = read("b.ies", open.text());
  expect_web(closed.web, none);
  ASSERT_FALSE(closed.warnings.empty());
  EXPECT_CONTAINS(closed.warnings[0], "the plane of 360 is taken to be that of 0");
  const Photometry round = read("c.ies", Ies().text());
  EXPECT_TRUE(symmetry_of(round.web).is_rotational);
  EXPECT_NEAR(flux(round.web), 400 * kPi, 1e-9 * 400 * kPi);
}

TEST_F(PhotometricFiles, OfIesTypesBAndAHaveTheirDirections) {
  const auto candela = [](double v, double h) { return 100 + v / 3 + h / 7; };
  for (const int type : {2, 3}) {
    Ies ies;
    ies.type = type;
    ies.vertical = steps(-90, 90, 10);
    ies.horizontal = steps(-90, 90, 15);
    ies.candela = candela;
    const PhotometricWeb web = read("a.ies", ies.text()).web;
    for (const double v : ies.vertical) {
      for (const double h : steps(-75, 75, 15)) {
        if (std::abs(v) == 90) continue;  // all H in one there
        const Vec3 way = type == 2 ? Vec3(sine(h), cosine(h) * sine(v), -cosine(h) * cosine(v))
                                   : Vec3(cosine(v) * sine(h), sine(v), -cosine(v) * cosine(h));
        EXPECT_NEAR(intensity(web, way), candela(v, h), 1e-9) << v << ' ' << h;
      }
    }
    // Linear terms are odd: half of the sphere times the mean.
    EXPECT_NEAR(flux(web), 200 * kPi, 1e-9 * 200 * kPi);
    // From 0 on: alike on both sides.
    ies.horizontal = steps(0, 90, 15);
    const PhotometricWeb half = read("b.ies", ies.text()).web;
    const Vec3 left(-sine(30), cosine(30) * sine(20), -cosine(30) * cosine(20));
    if (type == 2) {
      EXPECT_NEAR(intensity(half, left), candela(20, 30), 1e-9);
    }
  }
}

TEST_F(PhotometricFiles, OfEulumdatHaveTheirSymmetry) {
  struct Sample {
    int symmetry;
    std::vector<double> given;
    Candela candela;
  };
  const auto round = [](double gamma, double) { return 100 + gamma; };
  const std::vector<Sample> cases = {{0, steps(0, 345, 15), none},
                                     {1, {0}, round},
                                     {2, steps(0, 180, 15), to_c0},
                                     {3, steps(270, 450, 15), to_c90},
                                     {4, steps(0, 90, 15), to_both}};
  for (const Sample& sample : cases) {
    Ldt ldt;
    ldt.symmetry = sample.symmetry;
    ldt.given = sample.given;
    ldt.candela = sample.candela;
    const Photometry photometry = read("a.ldt", ldt.text());
    expect_web(photometry.web, sample.candela);
    EXPECT_EQ(photometry.lamp_flux, 2000);
    EXPECT_EQ(photometry.power, 25);
    EXPECT_DOUBLE_EQ(photometry.along_c0, 0.55);
    EXPECT_DOUBLE_EQ(photometry.along_c90, 1.15);
    EXPECT_EQ(photometry.name, "A lamp");
  }
}

TEST_F(PhotometricFiles, AreReadAsTheyAreFound) {
  Ies ies;
  ies.candela = [](double gamma, double) { return 100 + gamma; };
  const PhotometricWeb web = read("a.ies", ies.text()).web;
  const auto same = [&](const std::string& text) {
    const PhotometricWeb other = read("b.ies", text).web;
    EXPECT_EQ(other.intensity, web.intensity);
    EXPECT_EQ(other.polar, web.polar);
  };
  std::string text = ies.text();
  same("\xef\xbb\xbf" + text);
  same(text + "\r\n\x1a");
  std::string dos;
  for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
  same(dos);
  for (const char* head : {"IESNA91\n", "IESNA:LM-63-1995\n[TEST]\n", "", "some label\nmore\n",
                           "IES:LM-63-2019\n[TEST] x\n"}) {
    ies.head = head;
    same(ies.text());
  }
  ies.lamps = "2 -1 1";
  EXPECT_EQ(read("c.ies", ies.text()).lamp_flux, 0);
  ies.lamps = "2 900 0.5";
  ies.ballast = "0.8 0.5 40";
  ies.opening = "1 -1 -1 0";
  // In the edition of 2019 the second number of the ballast is a code of the file's origin.
  EXPECT_NEAR(flux(read("d.ies", ies.text()).web), 0.4 * flux(web), 1e-12 * flux(web));
  ies.head = "IESNA:LM-63-2002\n";
  const Photometry scaled = read("d.ies", ies.text());
  EXPECT_NEAR(flux(scaled.web), 0.2 * flux(web), 1e-12 * flux(web));
  EXPECT_EQ(scaled.lamp_flux, 1800);
  EXPECT_TRUE(scaled.is_round);
  EXPECT_EQ(scaled.along_c0, 0.3048);
  const std::string table = "1\n3\n0 45 90\n1 .9 .8\n";
  ies.tilt = "TILT=INCLUDE\n" + table;
  const Photometry tilted = read("e.ies", ies.text());
  EXPECT_TRUE(tilted.warnings.empty());
  EXPECT_EQ(tilted.tilt.position, 1);
  EXPECT_EQ(tilted.tilt.factors, (std::vector<double>{1, .9, .8}));
  EXPECT_NEAR(tilted.tilt.angles[2], kPi / 2, 1e-15);
  (void)file("lamp.tlt", table);
  ies.tilt = "TILT=lamp.tlt\n";
  EXPECT_NEAR(flux(read("f.ies", ies.text()).web), 0.2 * flux(web), 1e-12 * flux(web));
  // In any case of letters.
  EXPECT_EQ(read("f.ies", ies.text()).tilt.factors, tilted.tilt.factors);
  ies.tilt = "Tilt=include\n" + table;
  EXPECT_EQ(read("f.ies", ies.text()).tilt.factors, tilted.tilt.factors);
  ies.tilt = "tilt=None\n";
  EXPECT_TRUE(read("f.ies", ies.text()).tilt.factors.empty());
  // Commas are separators.
  Ies commas;
  std::string listed = commas.text();
  listed.replace(listed.find("1 1000 1"), 8, "1, 1000,1");
  EXPECT_NEAR(flux(read("g.ies", listed).web), 400 * kPi, 1e-6);
  Ldt absolute;
  absolute.lamps = "-1\nLED\n2000\n3000\n80\n25\n";
  EXPECT_EQ(read("h.ldt", absolute.text()).lamp_flux, 0);
  absolute.vertical = steps(0, 90, 15);
  EXPECT_NEAR(flux(read("i.ldt", absolute.text()).web), 200 * kPi, 1e-9 * 200 * kPi);
}

TEST_F(PhotometricFiles, TellTheirAngles) {
  // 100 cd at 0°, falling by 1 cd a degree to 90: half at 50°, a tenth at 90°.
  Ies ies;
  ies.vertical = steps(0, 90, 10);
  ies.candela = [](double gamma, double) { return 100 - gamma; };
  const PhotometricWeb web = read("a.ies", ies.text()).web;
  EXPECT_NEAR(spread(web, 0, 0.5), 100 * kPi / 180, 1e-12);
  EXPECT_NEAR(spread(web, 1, 0.1), 180 * kPi / 180, 1e-12);
  EXPECT_EQ(radiosity::peak_intensity(web).intensity, 100);
  EXPECT_NEAR(downward_flux(web), flux(web), 1e-12 * flux(web));
  const auto svg = folder() / "curve.svg";
  io::write_polar_curve(svg, read("b.ies", ies.text()));
  EXPECT_CONTAINS(radiosity::test::file_bytes(svg), "</svg>");
}

TEST_F(PhotometricFiles, OfIesAreRefusedInOneLine) {
  const auto refused = [&](const std::function<void(Ies&)>& change, const std::string& part) {
    Ies ies;
    change(ies);
    expect_refusal("a.ies", ies.text(), part);
  };
  refused([](Ies& f) { f.tilt = ""; }, "a.ies:11: has no line that starts with TILT=");
  refused([](Ies& f) { f.tilt = "TILT=no.tlt\n"; }, "a.ies:5: the file \"no.tlt\" of TILT is not");
  refused([](Ies& f) { f.tilt = "TILT=\n"; }, "TILT= is empty");
  refused([](Ies& f) { f.tilt = "TILT=INCLUDE\n1\n2\n90 0\n1 1\n"; },
          "tilt angle 0 does not follow");
  refused([](Ies& f) { f.lamps = "1 0 1"; }, "a.ies:6: the lumens of a lamp are 0, expected more");
  refused([](Ies& f) { f.lamps = "1 -3 1"; }, "lumens of a lamp are -3");
  refused([](Ies& f) { f.lamps = "0 1 1"; }, "found 0 for the number of lamps");
  refused([](Ies& f) { f.lamps = "1 1000 -1"; }, "multiplier of intensities is -1");
  refused([](Ies& f) { f.type = 4; }, "found 4 for the photometric type");
  refused([](Ies& f) { f.opening = "3 0 0 0"; }, "found 3 for the type of units");
  refused([](Ies& f) { f.ballast = "0 1 10"; }, "the ballast factor is 0");
  refused([](Ies& f) { f.ballast = "1 1 -10"; }, "the input power is -10 W");
  refused(
      [](Ies& f) {
        f.vertical = {0, 30, 30, 90};
      },
      "a.ies:8: vertical angle 30 does not follow");
  refused([](Ies& f) { f.vertical = {0, 190}; }, "vertical angle 190 is outside [0, 180]");
  refused([](Ies& f) { f.vertical = {0}; }, "a single angle spans nothing");
  refused([](Ies& f) { f.horizontal = {0, 45}; }, "the last horizontal angle is 45");
  refused([](Ies& f) { f.horizontal = {10, 90}; }, "horizontal angles from 10 to 90");
  refused([](Ies& f) { f.candela = [](double, double) { return -1.0; }; },
          "intensity -1 is negative");
  refused([](Ies& f) { f.candela = [](double, double) { return 0.0; }; }, "gives no light");
  refused([](Ies& f) { f.tail = "100 100\n"; }, "found \"100\" behind the last of 13 x 1");
  refused([](Ies& f) { f.lamps = "1 1000,5 1"; }, "a.ies");
  Ies many;
  std::string text = many.text();
  text.replace(text.find(" 13 1 1"), 7, " 1048576 1 1");
  expect_refusal("b.ies", text, "b.ies:6: found 1048576 for the number of vertical angles");
  text = many.text();
  expect_refusal("c.ies", text.substr(0, text.size() - 12), "c.ies:12: the file ends where");
  expect_refusal("d.ies", "IESNA91\nTILT=NONE\n1 x\n", "d.ies:3: expected a number for the lumens");
  expect_refusal("e.ies", "", "is empty");
}

TEST_F(PhotometricFiles, OfEulumdatAreRefusedInOneLine) {
  const auto refused = [&](const std::function<void(Ldt&)>& change, const std::string& part) {
    Ldt ldt;
    change(ldt);
    expect_refusal("a.ldt", ldt.text(), part);
  };
  refused([](Ldt& f) { f.symmetry = 5; }, "a.ldt:3: found 5 for the symmetry (Isym)");
  refused([](Ldt& f) { f.symmetry = 4, f.all = steps(0, 330, 24); }, "cannot have the symmetry 4");
  refused([](Ldt& f) { f.opening = "1\n1\n1\n-5\n1\n0\n0\n0\n0\n"; },
          "a.ldt:16: the length of the luminous area is -5");
  refused([](Ldt& f) { f.opening = "1,5\n1\n1\n5\n1\n0\n0\n0\n0\n"; },
          "decimal commas are not read");
  refused([](Ldt& f) { f.factor = "0"; }, "a.ldt:24: the conversion factor is 0");
  refused([](Ldt& f) { f.lamps = "1\nT5\n0\n3000\n80\n25\n"; }, "lumens of the lamps are 0");
  refused([](Ldt& f) { f.lamps = "1\nT5\n-1\n3000\n80\n25\n"; }, "lumens of the lamps are -1");
  refused(
      [](Ldt& f) {
        f.symmetry = 2, f.all = {0, 60, 120, 300}, f.given = {0, 60, 120};
      },
      "half of the C-planes ends at 120, expected 180");
  refused([](Ldt& f) { f.all[3] = 10; }, "C angle 10 does not follow 30");
  refused([](Ldt& f) { f.vertical[1] = 0; }, "gamma angle 0 does not follow 0");
  refused([](Ldt& f) { f.given.pop_back(); }, "the file ends before an intensity");
  refused([](Ldt& f) { f.given.push_back(0); }, "behind the last intensity");
  refused([](Ldt& f) { f.candela = [](double, double) { return -1.0; }; }, "an intensity is -");
  std::string many = Ldt().text();
  many.replace(many.find("\n13\n"), 4, "\n1048576\n");
  expect_refusal("b.ldt", many, "b.ldt:6: found 1048576 for the number of intensities");
  expect_refusal("c.ldt", "x\n", "c.ldt:1: the file ends before the type");
  expect_refusal("d.txt", "x\n", "expected a photometric file");
}

TEST_F(PhotometricFiles, OfEulumdatMayEndLinesAnyWay) {
  const std::string text = Ldt().text();
  const Photometry plain = read("a.ldt", text);
  std::string windows = "\xef\xbb\xbf";
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(read("b.ldt", windows + "\x1a").web.intensity, plain.web.intensity);
  EXPECT_EQ(read("b.ldt", windows).maker, "Nobody");
}

TEST_F(PhotometricFiles, OfEulumdatTellWhatDoesNotFit) {
  const auto warnings = [&](const Ldt& ldt, const std::string& from, const std::string& to) {
    std::string text = ldt.text();
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    std::string all;
    for (const std::string& warning : read("a.ldt", text).warnings) all += warning;
    return all;
  };
  Ldt ldt;
  ldt.lumens = 400 * kPi;
  ldt.lamps = fmt::format("1\nT5\n{}\n3000\n80\n25\n", 400 * kPi);
  EXPECT_EQ(warnings(ldt, "", ""), "");
  EXPECT_CONTAINS(warnings(ldt, "\n100\n100\n", "\n100\n70\n"),
                  "add up to 100 % of its lamps' light, but its light output ratio is 70 %");
  EXPECT_CONTAINS(warnings(ldt, "\n1\n0\n1\n1\n", "\n1\n15\n1\n1\n"), "was tilted by 15 degrees");
}

/// Bytes and numbers changed, lines taken out or twice: read, or refused in one line.
TEST_F(PhotometricFiles, SurviveAnyDamage) {
  std::mt19937_64 random(11);
  Ies ies;
  ies.horizontal = steps(0, 90, 45);
  ies.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 1\n";
  Ldt ldt;
  ldt.symmetry = 4;
  ldt.all = steps(0, 270, 90);
  ldt.given = {0, 90};
  constexpr std::array kWords{"-1", "0",   "1e308", "nan",         "1048576",
                              "-",  "1,5", "\n\n",  "999999999999"};
  int n_read = 0;
  for (int k = 0; k < 600; ++k) {
    const bool is_ies = k % 2 == 0;
    std::string text = is_ies ? ies.text() : ldt.text();
    for (std::size_t change = 0; change < 1 + random() % 3; ++change) {
      const std::size_t place = random() % text.size();
      switch (random() % 4) {
        case 0:
          text = radiosity::test::with_flip(text, 0, text.size(), random);
          break;
        case 1:
          text.erase(place, 1 + random() % 20);
          break;
        case 2:
          text.insert(place, kWords[random() % kWords.size()]);
          break;
        default:
          text.insert(place, text.substr(random() % text.size(), random() % 30));
      }
      if (text.size() < 50) break;
    }
    const std::string message = radiosity::test::outcome<radiosity::SceneError>(
        file(is_ies ? "m.ies" : "m.ldt", text), [&](const auto& path) {
          const Photometry photometry = io::read_photometric_file(path);
          ++n_read;
          EXPECT_TRUE(flux(photometry.web) > 0);
        });
    EXPECT_LT(message.size(), 2100U);
  }
  EXPECT_GT(n_read, 20);
}

}  // namespace
