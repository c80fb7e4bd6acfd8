/// Every promise about an error of one entry: the input that provokes it, and the message.

#include "scene/choices.h"
#include "scene_files.h"

namespace pseudorigid::scene {
namespace {

struct BadInput {
  const char* name;
  std::string text;
  std::vector<std::string> overrides;
  std::string message;  ///< how it begins, or all of it
};

std::ostream& operator<<(std::ostream& out, const BadInput& bad) { return out << bad.name; }

class BadInputTest : public test::SceneFiles, public ::testing::WithParamInterface<BadInput> {};

TEST_P(BadInputTest, IsRefusedInOneSentence) {
  const BadInput& bad = GetParam();
  const std::string message = complaint([&] { read(bad.text, bad.overrides); });
  EXPECT_EQ(message.substr(0, bad.message.size()), bad.message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_LT(message.size(), 500U);
}

std::string entry(const std::string& section, const std::string& setting) {
  return "subsection " + section + "\n  set " + setting + "\nend\n";
}

const std::string matrix_expected =
    "scene.prm:2: Initial state/Deformation: expected a 3x3 matrix of finite numbers, rows separated by \";\" and "
    "entries by \",\", got ";

INSTANTIATE_TEST_SUITE_P(
    Numbers, BadInputTest,
    ::testing::Values(
        BadInput{"negative",
                 entry("Material", "Shear modulus = -1"),
                 {},
                 "scene.prm:2: Material/Shear modulus: expected a number > 0, got \"-1\""},
        BadInput{"zero", entry("Body", "Radius = 0"), {}, "scene.prm:2: Body/Radius: expected a number > 0, got \"0\""},
        BadInput{"nan", entry("Body", "Density = nan"), {}, "scene.prm:2: Body/Density: expected a number > 0, got"},
        BadInput{"inf", entry("Time", "End = inf"), {}, "scene.prm:2: Time/End: expected a finite number, got \"inf\""},
        BadInput{"overflow", entry("Time", "End = 1e999"), {}, "scene.prm:2: Time/End: expected a finite number, got"},
        BadInput{
            "trailing", entry("Time", "End = 3 s"), {}, "scene.prm:2: Time/End: expected a finite number, got \"3 s\""},
        BadInput{
            "hex", entry("Time", "End = 0x10"), {}, "scene.prm:2: Time/End: expected a finite number, got \"0x10\""},
        BadInput{
            "decimal_comma", entry("Time", "End = 1,5"), {}, "scene.prm:2: Time/End: expected a finite number, got"},
        BadInput{"plus_minus", entry("Time", "End = +-1"), {}, "scene.prm:2: Time/End: expected a finite number, got"},
        BadInput{
            "empty", entry("Body", "Radius ="), {}, "scene.prm:2: Body/Radius: expected a number > 0, got nothing"},
        BadInput{"not_auto",
                 entry("Time", "Step = automatic"),
                 {},
                 "scene.prm:2: Time/Step: expected auto or a number > 0, got \"automatic\""},
        BadInput{"step_zero", entry("Time", "Step = 0"), {}, "scene.prm:2: Time/Step: expected auto or a number > 0"},
        BadInput{"tolerance_low",
                 entry("Time", "Tolerance = 1e-14"),
                 {},
                 "scene.prm:2: Time/Tolerance: expected a number from 1e-13 to 0.1, got \"1e-14\""},
        BadInput{"tolerance_high",
                 entry("Time", "Tolerance = 0.2"),
                 {},
                 "scene.prm:2: Time/Tolerance: expected a number from 1e-13 to 0.1, got \"0.2\""}));

INSTANTIATE_TEST_SUITE_P(
    Integers, BadInputTest,
    ::testing::Values(
        BadInput{"degree_low",
                 entry("Continuum", "Degree = 0"),
                 {},
                 "scene.prm:2: Continuum/Degree: expected auto or a whole number from 1 to 8, got \"0\""},
        BadInput{"degree_high",
                 entry("Continuum", "Degree = 9"),
                 {},
                 "scene.prm:2: Continuum/Degree: expected auto or a whole"},
        BadInput{"degree_real",
                 entry("Continuum", "Degree = 2.0"),
                 {},
                 "scene.prm:2: Continuum/Degree: expected auto or a whole"},
        BadInput{"refinements",
                 entry("Continuum", "Refinements = -1"),
                 {},
                 "scene.prm:2: Continuum/Refinements: expected auto or a whole number from 0 to 4, got \"-1\""},
        BadInput{"samples",
                 entry("Output", "Samples = 10000001"),
                 {},
                 "scene.prm:2: Output/Samples: expected a whole number from 1 to 10000000"},
        BadInput{"int_overflow",
                 entry("Output", "Frames = 99999999999"),
                 {},
                 "scene.prm:2: Output/Frames: expected a whole number >= 1, got \"99999999999\""}));

/// With the words of the table, in its order.
const std::string at_law = "scene.prm:2: Material/Law: expected " + law_kind().expected() + ", got ";
const std::string at_models =
    "scene.prm:1: Models: expected " + models_kind(test::test_catalogue()).expected() + ", got ";

INSTANTIATE_TEST_SUITE_P(
    Words, BadInputTest,
    ::testing::Values(
        BadInput{"boolean",
                 entry("Body", "Incompressible = yes"),
                 {},
                 "scene.prm:2: Body/Incompressible: expected true or false, got \"yes\""},
        BadInput{
            "law", entry("Material", "Law = neohookean"), {}, at_law + "\"neohookean\"; did you mean \"neo-hookean\"?"},
        BadInput{"capitals",
                 entry("Material", "Law = Neo-Hookean"),
                 {},
                 at_law + "\"Neo-Hookean\"; did you mean \"neo-hookean\"?"},
        BadInput{"method",
                 entry("Time", "Method = rattle4"),
                 {},
                 "scene.prm:2: Time/Method: expected one of auto, rattle, rattle-4, explicit-8, got "
                 "\"rattle4\"; did you mean \"rattle-4\"?"},
        BadInput{
            "symmetry", entry("Continuum", "Symmetry = quarter"), {}, "scene.prm:2: Continuum/Symmetry: expected one"},
        BadInput{"mesh",
                 entry("Continuum", "Mesh = file"),
                 {},
                 "scene.prm:2: Continuum/Mesh: expected builtin or the name of a .msh file, got"},
        BadInput{"graphics",
                 entry("Output", "Graphics = vtk"),
                 {},
                 "scene.prm:2: Output/Graphics: expected none or vtu, got \"vtk\"; did you mean \"vtu\"?"},
        BadInput{"system",
                 "set System = triple pendulum",
                 {},
                 "scene.prm:1: System: expected ball or top, got \"triple pend"},
        BadInput{
            "model", "set Models = reduced, continum", {}, at_models + "\"continum\"; did you mean \"continuum\"?"},
        BadInput{"model_comma", "set Models = reduced,", {}, at_models + "nothing"},
        BadInput{"quantity",
                 entry("Output", "Quantities = state, energy"),
                 {},
                 "scene.prm:2: Output/Quantities: expected a comma-separated list out of all, state, energies"},
        BadInput{"all_and_unknown",
                 entry("Output", "Quantities = all, energy"),
                 {},
                 "scene.prm:2: Output/Quantities: expected a comma"},
        BadInput{"directory",
                 entry("Output", "Directory ="),
                 {},
                 "scene.prm:2: Output/Directory: expected the name of a directory, got nothing"},
        BadInput{"home",
                 entry("Output", "Directory = ~nobody/results"),
                 {},
                 "scene.prm:2: Output/Directory: expected the name of a directory, got \"~nobody/results\", in which "
                 "\"~nobody\" is not replaced"},
        BadInput{
            "variable",
            entry("Output", "Directory = a/$PSEUDORIGID_NOTHING/b"),
            {},
            "scene.prm:2: Output/Directory: expected the name of a directory, got \"a/$PSEUDORIGID_NOTHING/b\", in "
            "which \"$PSEUDORIGID_NOTHING\" is not replaced"},
        BadInput{"variable_in_braces",
                 entry("Output", "Directory = ${X_}b"),
                 {},
                 "scene.prm:2: Output/Directory: expected the name of a directory, got \"${X_}b\", in which \"${X_}\""},
        BadInput{"expression",
                 entry("Output", "Directory = out$(1+1)"),
                 {},
                 "scene.prm:2: Output/Directory: expected the name of a directory, got \"out$(1+1)\", in which \"$(\""},
        BadInput{
            "integers",
            entry("Polynomial", "Degree = 5, 3"),
            {},
            "scene.prm:2: Polynomial/Degree: expected auto, or rising whole numbers separated by ',', each a whole "
            "number from 1 to 13, got \"5, 3\""}));

/// Characters that cannot be told from those of ASCII are named.
INSTANTIATE_TEST_SUITE_P(
    Characters, BadInputTest,
    ::testing::Values(
        BadInput{"minus",
                 entry("Time", "End = \u22120.2"),
                 {},
                 "scene.prm:2: Time/End: expected a finite number, got \"\u22120.2\" (with the minus sign U+2212 in "
                 "place of \"-\")"},
        BadInput{
            "en_dash",
            entry("Initial state", "Velocity = 0,\u20131,0; 0,0,0; 0,0,0"),
            {},
            "scene.prm:2: Initial state/Velocity: expected a 3x3 matrix of finite numbers, rows separated by \";\" "
            "and entries by \",\", got \"\u20131\" (with the en dash U+2013 in place of \"-\") as entry (1,2)"},
        BadInput{"before_equals",
                 entry("Time", "End\u00A0= 1"),
                 {},
                 "scene.prm:2: unknown entry \"Time/End\u00A0\" (with the no-break space U+00A0 in place of a blank); "
                 "did you mean \"Time/End\"?"},
        BadInput{"after_equals",
                 entry("Time", "End =\u00A01"),
                 {},
                 "scene.prm:2: Time/End: expected a finite number, got \"\u00A01\" (with the no-break space U+00A0"},
        BadInput{"override",
                 "",
                 {"Time/End=\u22121"},
                 "--set: Time/End: expected a finite number, got \"\u22121\" (with the minus sign U+2212"},
        BadInput{"word",
                 entry("Material", "Law = neo\u2011hookean"),
                 {},
                 at_law + "\"neo\u2011hookean\" (with the no-break hyphen U+2011 in place of \"-\"); did you mean"},
        BadInput{"expression",
                 entry("Time", "End = $(2\u22121)"),
                 {},
                 "scene.prm:2: Time/End: \"2\u22121\" (with the minus sign U+2212 in place of \"-\") cannot be"},
        BadInput{"model",
                 "set Models = reduced,\u00A0continuum",
                 {},
                 "scene.prm:1: Models: expected a comma-separated list out of reduced, polynomial, continuum, got "
                 "\"\u00A0continuum\" (with the no-break space U+00A0"}));

INSTANTIATE_TEST_SUITE_P(
    Sweeps, BadInputTest,
    ::testing::Values(
        BadInput{"function",
                 entry("Sweep", "Parameters = sin: 1, 2"),
                 {},
                 "scene.prm:2: Sweep/Parameters: expected nothing, or parameters \"name: first .. last in n\", with "
                 "\"logarithmic\" or \"latin SEED\" after it if wanted, or \"name: value, value\", separated by \";\", "
                 "got \"sin: 1, 2\", where \"sin\" is a function of expressions"},
        BadInput{"constant",
                 entry("Sweep", "Parameters = l: 1, 2; pi: 3, 4"),
                 {},
                 "scene.prm:2: Sweep/Parameters: expected nothing, or parameters \"name: first .. last in n\", with "
                 "\"logarithmic\" or \"latin SEED\" after it if wanted, or \"name: value, value\", separated by \";\", "
                 "got \"pi: 3, 4\", where \"pi\" is a constant of expressions"},
        BadInput{"number",
                 entry("Sweep", "Parameters = l: 1 .. 2 in 2.5"),
                 {},
                 "scene.prm:2: Sweep/Parameters: expected nothing, or parameters \"name: first .. last in n\", with "
                 "\"logarithmic\" or \"latin SEED\" after it if wanted, or \"name: value, value\", separated by \";\", "
                 "got \"1 .. 2 in 2.5\", where the number of values is not a whole"},
        BadInput{"too_many",
                 entry("Sweep", "Parameters = l: 1 .. 2 in 9999999; k: 1, 2"),
                 {},
                 "scene.prm:2: Sweep/Parameters: expected nothing, or parameters \"name: first .. last in n\", with "
                 "\"logarithmic\" or \"latin SEED\" after it if wanted, or \"name: value, value\", separated by \";\", "
                 "got \"l: 1 .. 2 in 9999999; k: 1, 2\", which are more than"},
        BadInput{"twice",
                 entry("Sweep", "Parameters = l: 1; l: 2"),
                 {},
                 "scene.prm:2: Sweep/Parameters: expected nothing, or parameters \"name: first .. last in n\", with "
                 "\"logarithmic\" or \"latin SEED\" after it if wanted, or \"name: value, value\", separated by \";\", "
                 "got \"l: 1; l: 2\", where \"l\" occurs twice"},
        BadInput{"list_in_expression",
                 entry("Time", "End = $(2,5)"),
                 {},
                 "scene.prm:2: Time/End: \"2,5\" is a list of 2 numbers and not one"}));

INSTANTIATE_TEST_SUITE_P(
    Matrices, BadInputTest,
    ::testing::Values(BadInput{"rows",
                               entry("Initial state", "Deformation = 1,0,0; 0,1,0"),
                               {},
                               matrix_expected + "\"1,0,0; 0,1,0\", which has 2 rows"},
                      BadInput{"entries",
                               entry("Initial state", "Deformation = 1,0,0; 0,1; 0,0,1"),
                               {},
                               matrix_expected + "\"1,0,0; 0,1; 0,0,1\", where row 2 has 2 entries"},
                      BadInput{"blanks",
                               entry("Initial state", "Deformation = 1 0 0; 0 1 0; 0 0 1"),
                               {},
                               matrix_expected + "\"1 0 0; 0 1 0; 0 0 1\", where row 1 has 1 entry"},
                      BadInput{"word",
                               entry("Initial state", "Deformation = 1,0,0; 0,1,0; 0,one,1"),
                               {},
                               matrix_expected + "\"one\" as entry (3,2)"},
                      BadInput{"infinite",
                               entry("Initial state", "Deformation = 1,0,0; 0,-inf,0; 0,0,1"),
                               {},
                               matrix_expected + "\"-inf\" as entry (2,2)"},
                      BadInput{"trailing_semicolon",
                               entry("Initial state", "Deformation = 1,0,0; 0,1,0; 0,0,1;"),
                               {},
                               matrix_expected + "\"1,0,0; 0,1,0; 0,0,1;\", which has 4 rows"},
                      BadInput{"nothing",
                               entry("Initial state", "Deformation ="),
                               {},
                               matrix_expected + "nothing, which has 0 rows"}));

INSTANTIATE_TEST_SUITE_P(
    Names, BadInputTest,
    ::testing::Values(
        BadInput{"misspelt",
                 "subsection Body\n\nset Radiuss = 1\nend",
                 {},
                 "scene.prm:3: unknown entry \"Body/Radiuss\"; did you mean \"Body/Radius\"?"},
        BadInput{"case",
                 entry("Body", "radius = 1"),
                 {},
                 "scene.prm:2: unknown entry \"Body/radius\"; did you mean \"Body/Radius\"?"},
        BadInput{
            "misplaced", "set Radius = 1", {}, "scene.prm:1: unknown entry \"Radius\"; did you mean \"Body/Radius\"?"},
        BadInput{"other_section",
                 entry("Material", "Density = 1"),
                 {},
                 "scene.prm:2: unknown entry \"Material/Density\"; did you mean \"Body/Density\"?"},
        BadInput{"far",
                 entry("Body", "Colour of the moon = 1"),
                 {},
                 "scene.prm:2: unknown entry \"Body/Colour of the moon\""},
        BadInput{"section", "subsection Bodies\nend", {}, "scene.prm:1: unknown subsection \"Bodies\""},
        BadInput{"near_section",
                 "subsection initial State\nend",
                 {},
                 "scene.prm:1: unknown subsection \"initial State\"; did you mean \"Initial state\"?"},
        BadInput{"nested",
                 "subsection Body\nsubsection Body\nend\nend",
                 {},
                 "scene.prm:2: subsection \"Body\" begins inside subsection \"Body\""},
        BadInput{
            "missing_end",
            "subsection Body\nset Radius = 2\nsubsection Material\nend",
            {},
            "scene.prm:3: subsection \"Material\" begins inside subsection \"Body\"; is the \"end\" of Body missing"},
        BadInput{"last_word",
                 entry("Material", "Lambda = 1"),
                 {},
                 "scene.prm:2: unknown entry \"Material/Lambda\"; did you mean \"Material/Lame lambda\"?"},
        BadInput{"not_offered", entry("Body", "Gravity = 1"), {}, "scene.prm:2: unknown entry \"Body/Gravity\""},
        BadInput{"terminal_escape", "set \x1b[31mA = 1", {}, "scene.prm:1: expected text, got control characters"},
        BadInput{"long_name", "set " + std::string(900'000, 'A') + " = 1", {}, "scene.prm:1: unknown entry \"AAAA"}));

INSTANTIATE_TEST_SUITE_P(
    Overrides, BadInputTest,
    ::testing::Values(
        BadInput{"no_equals", "", {"Body/Radius"}, "--set: expected \"Section/Entry=value\", got \"Body/Radius\""},
        BadInput{"no_name", "", {"=1"}, "--set: unknown entry \"\""},
        BadInput{
            "unknown", "", {"Body/Radiuss=1"}, "--set: unknown entry \"Body/Radiuss\"; did you mean \"Body/Radius\"?"},
        BadInput{"value", "", {"Body/Radius=-1"}, "--set: Body/Radius: expected a number > 0, got \"-1\""},
        BadInput{"hash", "", {"Title=a # b"}, "--set: Title: expected a value on one line without \"#\", got"},
        BadInput{"newline", "", {"Title=a\nb"}, "--set: Title: expected a value on one line without \"#\", got"},
        BadInput{"file_first", entry("Body", "Radius = x"), {"Body/Radius=1"}, "scene.prm:2: Body/Radius: expected"}));

}  // namespace
}  // namespace pseudorigid::scene
