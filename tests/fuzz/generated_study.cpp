#include "tests/fuzz/generated_study.h"

#include <algorithm>
#include <set>
#include <utility>

#include "simulation/run/expectation.h"
#include "studies/measure/metric.h"
#include "tests/fuzz/drawn_text.h"
#include "tests/fuzz/generated_robot.h"

namespace hookpoint::fuzz {
namespace {

using language::FieldType;
using Words = std::vector<std::string>;

class StudyDrawing : DrawnText {
 public:
  using DrawnText::DrawnText;

  GeneratedExperiment study() {
    scene();
    const std::size_t kind = below(5);
    if (kind < 3)
      study_block();
    else if (kind == 3)
      tune_block();
    else
      calibrate_block();
    const auto command = kind < 3 ? GeneratedCommand::study : GeneratedCommand::tune;
    return {command, std::move(text_), {}, std::move(files_)};
  }

 private:
  /// `usually`; now and then a value that hardly fits.
  std::string rarely_wrong(const std::string& usually) {
    if (!chance(degenerate_)) return usually;
    return one_of(Words{"0", "-1", "5e-324", "1e300", "1e300 s", "1e308 m", "1e17 s", "nobody",
                        "\"\"", "0.5", "1 / 0", "-0", "4 kg"});
  }
  void field(const std::string& name, const std::string& usually) {
    write(name + " = " + rarely_wrong(usually) + ";");
  }
  void maybe(double part, const std::string& name, const std::string& usually) {
    if (chance(part)) field(name, usually);
  }
  std::string length(double least, double greatest) {
    return number(between(least, greatest)) + " " + one_of(Words{"mm", "cm"});
  }

  // The scene: Params that blocks may vary, a ground of one of two Materials, a robot.

  void scene() {
    std::string text =
        "Param mu = 0.4;\nParam stiffness = 20 kN/m;\nParam height = 1 cm;\n"
        "Param speed = 0 m/s;\nParam slope = 4 deg;\nParam soil = clay;\n";
    const bool fixed_time = chance(0.9);
    text += "World world { gravity = 9.81; deltat = " + std::string(fixed_time ? "1 ms" : "auto") +
            "; duration = 0.02 s; seed = 3;\n";
    if (chance(0.5)) text += "contact = " + one_of(choices("World", "contact")) + ";\n";
    text +=
        "Material clay { static_friction = mu; kinetic_friction = mu; normal_stiffness = "
        "stiffness; "
        "}\nMaterial oak { static_friction = 0.6; }\n"
        "Terrain.Slope ground { angle = slope; material = soil; }\n";
    if (chance(0.15)) {
      const GeneratedRobot drawn = generate_robot(random_(), 0.);
      files_.insert(files_.end(), drawn.files.begin(), drawn.files.end());
      text += "Include \"" + drawn.files.front().name + "\" (name = block, location = 0, 0, 0.4" +
              drawn.arguments + ");\n";
    } else {
      text +=
          "Robot block { Base.mobile { rest_on = ground; velocity = speed, 0, 0; Shape.Box { "
          "dimensions = 0.2, 0.2, 10 * height; mass = 1 kg; } }\n";
      if (chance(0.4))
        text +=
            "Chain arm { hip_distance = 0, 0, 0.1 m; Link rod { mass = 0.1 kg; inertia = 1e-3, "
            "1e-3, 1e-3, 0, 0, 0; dhlength = height; } }\n";
      text += "}\n";
    }
    if (chance(0.5)) text += signals();
    text += "}\n";
    if (chance(0.4))
      text +=
          "Expect risen { of = world.block.base.location.z; take = mean; equals = height; "
          "within = 1 m; }\n";
    files_.push_back({"scene.hook", text});
    files_.push_back(
        {"ground.hook",
         "Param angle = 2 deg;\nMaterial felt { static_friction = 0.7; }\nTerrain.Slope "
         "ground { angle = angle; material = felt; }\n" +
             std::string(chance(0.03) ? "Plugin \"none.so\";\n" : "")});
  }

  /// Blocks that pass a height on, in a row.
  std::string signals() {
    const std::string from = "block.base.location.z";
    const Words blocks{
        "Filter f { frequency = 50 Hz; Wire FROM " + from + " TO input; }\n",
        "Delay d { time = 3 ms; Wire FROM " + from + " TO input; }\n",
        "Sample s { rate = 200 Hz; Wire FROM " + from + " TO input; }\n",
        "Switch w { in = 1, 2; threshold = 0.05; Wire FROM " + from + " TO control; }\n",
        "Expression e { formula = \"" + from + " / 1 m + 0.5 * previous\"; }\n",
        "StateMachine m { State up { output = \"1\"; } State down { output = \"time_in_state / 1 "
        "s\"; } Transition fall { from = up; to = down; when = \"time_in_state > 2 ms\"; } }\n"};
    std::string text;
    for (const std::string& block : blocks)
      if (chance(0.25)) text += block;
    return text;
  }

  // Tables of what was measured.

  void tables() {
    std::string cases = "run,height [cm],speed [m/s],who\n", curves = "run,t [ms],z [mm],v [m/s]\n";
    static const Words who{"Ada", "Ben"};
    for (std::size_t i = 0, count = 2 + below(2); i < count; ++i) {
      const std::string name = std::to_string(7 * i + 1);
      cases += name + "," + cell(0.5, 2.) + "," + cell(0., 0.3) + "," + one_of(who) + "\n";
      double time = 0.;
      for (int sample = 0; sample < 5; ++sample) {
        time += between(1., 6.);
        curves += name + "," + (chance(0.5 * degenerate_) ? "1e300" : number(time)) + "," +
                  cell(40., 70.) + "," + cell(-0.5, 0.5) + "\n";
      }
    }
    files_.push_back({"cases.csv", cases});
    files_.push_back({"curves.csv", curves});
    files_.push_back({"one.csv", "t [ms],z [mm]\n2,50\n5," + cell(40., 60.) + "\n11,52\n"});
  }
  std::string cell(double least, double greatest) {
    if (!chance(0.5 * degenerate_)) return number(between(least, greatest));
    return one_of(Words{"", "nan", "1e300", "-1e308", "1e309", "x", "0"});
  }
  void cases_block(bool of_study) {
    tables();
    write("Cases run { file = \"cases.csv\"; case = run;");
    if (!of_study || chance(0.7)) {
      write(
          "Trace zz { file = \"curves.csv\"; column = z; time = \"t\"; of = "
          "world.block.base.location.z;");
      if (!of_study) field("weight", "1 / (1 mm)");
      write("}");
      traces_ = true;
    }
    if (chance(0.2)) write("Only who { values = Ada; }");
    write("}");
    sweeps_.push_back("run");
  }

  // Study.

  void study_block() {
    write("Study drawn { scene = \"scene.hook\";");
    maybe(0.3, "title", "\"A <b>title</b> & more\"");
    maybe(0.2, "body", "block");
    const bool cases = chance(0.35);
    if (cases) cases_block(true);
    if (!traces_ || chance(0.3)) field("duration", number(between(0.005, 0.03)) + " s");
    maybe(0.4, "settle", "2 ms");
    maybe(0.1, "quick_duration", "4 ms");
    maybe(0.3, "seeds", std::to_string(1 + below(3)));
    if (chance(0.1)) write("match = hookpoint;");
    maybe(0.2, "expects", chance(0.5) ? "true" : "false");
    for (std::size_t i = below(3); i > 0; --i) sweep();
    for (std::size_t i = 0, count = 1 + below(3); i < count; ++i) subject();
    for (std::size_t i = 1 + below(4); i > 0; --i) measure();
    for (std::size_t i = below(3); i > 0; --i) truth();
    for (std::size_t i = below(3); i > 0; --i) plot();
    for (std::size_t i = below(2); i > 0; --i) table();
    for (std::size_t i = below(2); i > 0; --i) claim();
    if (!is_swept("speed") && chance(0.2))
      write("Fix speed { value = " + rarely_wrong("0.1 m/s") + "; }");
    write("}");
  }

  void subject() {
    const std::string name = "s" + std::to_string(subjects_.size());
    write("Subject " + name + " {");
    const bool free = !is_swept("engine") && !is_swept("contact");
    if (!free) {
      write("integrator = semi_implicit_euler;");
    } else if (chance(0.3)) {
      write("engine = " + one_of(choices("World", "engine")) + ";");
      maybe(0.5, "settings", one_of(Words{"default", "recommended", "matched"}));
    } else {
      maybe(0.6, "contact", one_of(choices("World", "contact")));
      maybe(0.2, "integrator", one_of(choices("World", "integrator")));
    }
    if (chance(0.2) && !sweeps_.empty()) only();
    write("}");
    subjects_.push_back(name);
  }

  void sweep() {
    const std::string name =
        one_of(Words{"mu", "slope", "height", "soil", "engine", "contact", "terrain", "speed"});
    if (is_swept(name)) return;
    write("Sweep " + name + " {");
    if (name == "soil") {
      write("values = clay, oak;");
    } else if (name == "engine") {
      write("values = dts, ode;");
    } else if (name == "contact") {
      write("values = hookpoint, " + one_of(choices("World", "contact")) + ";");
    } else if (name == "terrain") {
      write("values = \"ground.hook\";");
    } else {
      const std::string unit = name == "slope"    ? " deg"
                               : name == "height" ? " cm"
                               : name == "speed"  ? " m/s"
                                                  : "";
      if (chance(0.5)) {
        write("values = " + rarely_wrong("0.1" + unit) + ", " + number(between(0.2, 2.)) + unit +
              ";");
      } else {
        field("from", "0.1" + unit);
        field("to", "1" + unit);
        field("count", "2");
        maybe(0.3, "scale", "log");
      }
    }
    write("}");
    sweeps_.push_back(name);
  }

  /// Also what the cases set.
  bool is_swept(const std::string& name) const {
    const auto has = [&](const char* wanted) {
      return std::ranges::find(sweeps_, wanted) != sweeps_.end();
    };
    return has(name.c_str()) || ((name == "height" || name == "speed") && has("run"));
  }
  /// A sweep other than `taken`; "" where there is none.
  std::string other_sweep(const std::string& taken) {
    Words others = sweeps_;
    std::erase(others, taken);
    return others.empty() ? "" : one_of(others);
  }

  void only() {
    static const std::vector<std::pair<std::string, std::string>> values{
        {"mu", "from = 0;"},
        {"soil", "values = clay;"},
        {"run", "values = 1, 8;"},
        {"slope", "to = 100 deg;"},
        {"height", "from = 0 cm;"}};
    const auto& [name, range] = one_of(values);
    if (is_swept(name) || chance(degenerate_)) write("Only " + name + " { " + rarely(range) + " }");
  }
  std::string rarely(const std::string& range) {
    return chance(degenerate_) ? "values = " + rarely_wrong("1") + ";" : range;
  }

  void measure() {
    if (chance(0.5)) {
      const std::string name(studies::metric_table()[below(studies::metric_table().size())].name);
      if (!measures_.insert(name).second) return;
      return write("Measure " + name + ";");
    }
    const std::string name = "own" + std::to_string(measures_.size());
    write("Measure " + name + " {");
    const bool trace = traces_ && chance(0.5);
    static const std::vector<std::pair<std::string, std::string>> ports{
        {"world.block.base.location.z", "5 cm"},
        {"world.block.base.velocity.x", "0.1 m/s"},
        {"abs(world.block.base.velocity.z)", "1 mm/s"},
        {"world.time", "3 ms"}};
    const auto& [port, level] = one_of(ports);
    if (trace)
      write("trace = zz;");
    else
      field("of", chance(0.05) ? "1 / world.block.base.velocity.y" : port);
    const std::string take = one_of(simulation::reduction_names());
    field("take", take);
    maybe(0.3, "from", "1 ms");
    maybe(0.2, "to", "4 ms");
    const bool about = take == "time_at" || take.ends_with("_above");
    if (about || chance(degenerate_)) field("level", trace ? "5 cm" : level);
    if (take == "settle_time") field("band", trace ? "1 cm" : level);
    maybe(degenerate_, "unit", "mm");
    if (level == "5 cm" && !trace && (take == "last" || take == "mean"))
      maybe(0.3, "predicted", one_of(Words{"height", "height / mu", "height / (mu - 0.4)"}));
    write("}");
    measures_.insert(name);
  }

  std::string metric() {
    if (measures_.empty()) return "creep_speed";
    auto place = measures_.begin();
    std::advance(place, static_cast<std::ptrdiff_t>(below(measures_.size())));
    return *place;
  }
  void truth() {
    const std::string name = metric();
    if (!truths_.insert(name).second) return;
    write("Truth " + name + " {");
    switch (below(4)) {
      case 0:
        write("equals = predicted;");
        field("tolerance", "10 %");
        break;
      case 1:
        field("above", "-1e9");
        break;
      case 2:
        field("below", "1e9");
        break;
      default:
        if (sweeps_.empty()) return write("above = -1e9; }");
        write("same_over = " + one_of(sweeps_) + ";");
        field("tolerance", "1");
    }
    if (chance(0.2)) only();
    write("}");
  }

  void plot() {
    write("Plot p" + std::to_string(named_++) + " {");
    const bool over_time = sweeps_.empty() || chance(0.3);
    const std::string x = over_time ? "time" : one_of(sweeps_), other = other_sweep(x);
    write("x = " + rarely_wrong(x) + ";");
    write("y = " +
          (over_time ? one_of(Words{"displacement", "speed", "penetration", "energy"}) : metric()) +
          ";");
    maybe(0.3, "scale", one_of(Words{"linear", "log", "log_x", "log_log"}));
    maybe(0.2, "series", "subject");
    if (!other.empty()) maybe(0.3, "panels", other);
    if (sweeps_.size() > 1) maybe(degenerate_, "colour", metric());
    maybe(0.2, "floor", "1e-9");
    if (chance(0.2)) write("Reference line { value = " + rarely_wrong("0.01") + "; }");
    if (chance(0.2)) only();
    write("}");
  }

  void table() {
    if (sweeps_.empty()) return;
    write("Table t" + std::to_string(named_++) + " { rows = subject; columns = " +
          rarely_wrong(one_of(sweeps_)) + "; value = " + metric() + "; }");
  }

  void claim() {
    write("Claim c" + std::to_string(named_++) + " { text = \"It is {" +
          one_of(Words{"", "least ", "largest ", "predicted ", "subject of least "}) + metric() +
          (chance(0.5) ? " of " + subjects_.front() : "") + "}, " +
          one_of(Words{"", "twice", chance(degenerate_) ? "{" : "",
                       "{" + metric() + " / " + metric() + "}"}) +
          ".\"; }");
  }

  // Tune and Calibrate.

  void head(const std::string& type) {
    write(type + " drawn { scene = \"scene.hook\";");
    const bool ground = chance(0.2);
    if (ground) write("terrain = \"ground.hook\";");
    write("material = " + std::string(ground ? "felt" : "clay") + ";");
  }
  void vary() {
    const std::vector<std::pair<std::string, std::string>> ranges{
        {"normal_damping", "from = 10 N.s/m; to = 300 N.s/m;"},
        {"tangential_stiffness", "from = 1 kN/m; to = 100 kN/m; scale = log;"},
        {"height", "from = 0 cm; to = 2 cm;"},
        {"mu", "from = 0.1; to = 1;"},
        {"stiffness", "from = 5 kN/m; to = 50 kN/m; scale = log;"}};
    std::set<std::size_t> taken;
    for (std::size_t i = 1 + below(2); i > 0; --i) taken.insert(below(ranges.size()));
    for (const std::size_t i : taken) {
      if (chance(degenerate_))
        write("Vary " + ranges[i].first + " { from = " + rarely_wrong("0") +
              "; to = " + rarely_wrong("1") + "; }");
      else
        write("Vary " + ranges[i].first + " { " + ranges[i].second + " }");
    }
  }

  void tune_block() {
    head("Tune");
    vary();
    write("population = 8; generations = " + rarely_wrong(std::to_string(1 + below(2))) +
          "; seeds = " + rarely_wrong(std::to_string(1 + below(2))) + ";");
    const bool one = chance(0.4);
    write(std::string("method = ") + (one ? "cmaes" : "nsga2") + ";");
    maybe(0.9, "samples", std::to_string(below(3)));
    maybe(0.6, "duration", "10 ms");
    maybe(0.3, "settle", "2 ms");
    maybe(0.3, "seed", "5");
    static const Words metrics{"penetration_max", "penetration_mean", "creep_speed",
                               "contact_breaks",  "energy_gain",      "stable_step"};
    std::set<std::string> chosen;
    for (std::size_t i = one ? 1 : 1 + below(2); i > 0; --i) chosen.insert(one_of(metrics));
    for (const std::string& name : chosen)
      write("Objective " + name + " { " + (chance(0.7) ? "minimise;" : "maximise;") +
            (chance(0.3) ? " take = worst;" : "") + " }");
    if (chance(0.3)) write("Require penetration_rms { below = " + rarely_wrong("1 m") + "; }");
    if (chance(0.2)) subject();
    if (chance(0.2)) write("Fix speed { value = 0.1 m/s; }");
    write("}");
  }

  void calibrate_block() {
    head("Calibrate");
    vary();
    if (chance(0.5)) {
      cases_block(false);
    } else {
      tables();
      for (std::size_t i = 1 + below(2); i > 0; --i) {
        write("Trace k" + std::to_string(named_++) +
              " { file = \"one.csv\"; column = z; time = \"t\"; of = world.block.base.location.z;");
        field("weight", "1 / (1 mm)");
        if (chance(0.2)) write("Fix height { value = 0.5 cm; }");
        write("}");
      }
    }
    field("starts", std::to_string(1 + below(2)));
    field("folds", std::to_string(below(4)));
    field("resamples", std::to_string(2 * below(2)));
    maybe(0.4, "bootstrap", one_of(Words{"refits", "one_step"}));
    if (chance(0.4)) {
      write("method = cmaes; population = 8;");
      field("generations", "2");
      maybe(0.5, "most_cases", std::to_string(1 + below(2)));
    }
    maybe(0.2, "subjects", "hunt_crossley");
    if (chance(0.2)) subject();
    write("}");
  }

  std::vector<GeneratedFile> files_;
  Words subjects_, sweeps_;
  std::set<std::string> measures_, truths_;
  std::size_t named_ = 0;
  bool traces_ = false;
};

}  // namespace

GeneratedExperiment generate_study(const language::Schema& schema, std::uint64_t seed) {
  return StudyDrawing(schema, seed).study();
}

}  // namespace hookpoint::fuzz
