#include "studies/schema.h"

#include <utility>
#include <vector>

#include "simulation/run/expectation.h"

namespace hookpoint::studies {
namespace {

using language::ClassSchema;
using language::FieldSchema;
using language::FieldType;
using language::Naming;
using language::Schema;

FieldSchema text(std::string name, std::string doc) {
  FieldSchema field;
  field.name = std::move(name);
  field.type = FieldType::text;
  field.doc = std::move(doc);
  return field;
}

FieldSchema number(std::string name, std::string unit, std::string doc) {
  FieldSchema field;
  field.name = std::move(name);
  field.unit = std::move(unit);
  field.doc = std::move(doc);
  return field;
}

FieldSchema formula(std::string name, std::string doc) {
  FieldSchema field = text(std::move(name), std::move(doc));
  field.type = FieldType::formula;
  return field;
}

FieldSchema boolean(std::string name, bool value, std::string doc) {
  FieldSchema field = text(std::move(name), std::move(doc));
  field.type = FieldType::boolean;
  field.default_text = value ? "true" : "false";
  return field;
}

FieldSchema integer(std::string name, std::string doc) {
  FieldSchema field = number(std::move(name), "", std::move(doc));
  field.type = FieldType::integer;
  return field;
}

FieldSchema at_least_zero(FieldSchema field) {
  field.minimum = 0.;
  return field;
}

FieldSchema positive(FieldSchema field) {
  field.minimum = 0.;
  field.exclusive_minimum = true;
  return field;
}

FieldSchema within(double least, double most, FieldSchema field) {
  field.minimum = least;
  field.maximum = most;
  return field;
}

FieldSchema values(std::string name, std::string doc) {
  FieldSchema field = number(std::move(name), "?", std::move(doc));
  field.type = FieldType::numbers;
  field.max_count = 1000;
  return field;
}

FieldSchema or_words(FieldSchema field) {
  field.or_words = true;
  return field;
}

FieldSchema choice(std::string name, std::vector<std::string> choices, std::string default_text,
                   std::string doc) {
  FieldSchema field;
  field.name = std::move(name);
  field.type = FieldType::choice;
  field.choices = std::move(choices);
  field.default_text = std::move(default_text);
  field.doc = std::move(doc);
  return field;
}

FieldSchema words(std::string name, int most, std::string doc) {
  FieldSchema field;
  field.name = std::move(name);
  field.type = FieldType::words;
  field.max_count = most;
  field.doc = std::move(doc);
  return field;
}

FieldSchema with_default(FieldSchema field, std::string default_text) {
  field.default_text = std::move(default_text);
  return field;
}

FieldSchema required(FieldSchema field) {
  field.required = true;
  return field;
}

FieldSchema may_be_empty(const std::string& what) {
  return boolean("may_be_empty", false, "whether it is no failure that " + what);
}

/// A field of World as a Subject may set it: the same choices, no default.
FieldSchema of_world(const Schema& schema, const std::string& name, std::string doc) {
  const ClassSchema* world = schema.find("World");
  const FieldSchema* field = world == nullptr ? nullptr : world->find(name);
  if (field == nullptr || field->type != FieldType::choice) return words(name, 1, std::move(doc));
  return choice(name, field->choices, "", std::move(doc));
}

ClassSchema named(std::string name, std::string doc, std::vector<FieldSchema> fields,
                  std::vector<std::string> children = {}) {
  ClassSchema schema;
  schema.name = std::move(name);
  schema.doc = std::move(doc);
  schema.fields = std::move(fields);
  schema.children = std::move(children);
  schema.naming = Naming::required;
  schema.names_a_subject = schema.name != "Study" && schema.name != "Wall" &&
                           schema.name != "Matrix" && schema.name != "Tune" &&
                           schema.name != "Calibrate";
  return schema;
}

ClassSchema study_class() {
  ClassSchema study = named(
      "Study",
      "One scene under every subject and parameter value, measured and held against closed forms.",
      {text("title", "heading of the report"),
       text("question", "what the study asks, first thing in the report"),
       required(text("scene", "file of the world, whose Params a Sweep may vary")),
       formula("body",
               "the body that metrics of motion look at: a robot, which stands for its base, or a "
               "link; default: the base of the first mobile robot, or else the end of the first "
               "chain"),
       positive(number("duration", "s",
                       "simulated time of every run; default, with Cases that have Traces: each "
                       "up to its last sample")),
       with_default(
           at_least_zero(number("settle", "s",
                                "time from which metrics are measured: the start may ring; the "
                                "manual says which metrics are of the whole run")),
           "0"),
       positive(number("quick_duration", "s", "duration under --quick; default: a fifth")),
       at_least_zero(number("quick_settle", "s", "settle under --quick; default: a fifth")),
       within(1, 10000,
              integer("seeds",
                      "runs of each row, with the seeds 1, 2, 3 ...; default: one, with the "
                      "scene's own")),
       choice("match", {"hookpoint"}, "",
              "choose every law's constants so that the ground is as deep and stiff under the "
              "scene's load, and rebounds as much, as hookpoint's"),
       boolean("expects", true,
               "whether the Expects of the scene are measured and judged too, where the study runs "
               "as long as the scene")},
      {"Subject", "Sweep", "Cases", "Measure", "Truth", "Plot", "Table", "Claim", "Fix"});
  study.top_level = true;
  return study;
}

ClassSchema wall_class() {
  ClassSchema wall = named("Wall",
                           "Scenes that bring their own truths (Expect), each under every subject "
                           "that its truths cover.",
                           {text("title", "heading of the report"),
                            text("question", "what the wall shows, first thing in the report")},
                           {"Scene", "Subject"});
  wall.top_level = true;
  return wall;
}

ClassSchema matrix_class() {
  ClassSchema matrix = named("Matrix",
                             "Studies of other files, run one after the other and told in one page "
                             "of subjects, scenes and metrics.",
                             {text("title", "heading of the page"),
                              text("question", "what the matrix shows, first thing in the page")},
                             {"Part"});
  matrix.top_level = true;
  return matrix;
}

FieldSchema runs_under_quick() {
  return boolean("quick", true, "whether it runs under --quick too");
}

ClassSchema part_class() {
  return named("Part", "The studies of a file in a Matrix, by the name of the file in studies/.",
               {text("file", "if not studies/NAME.hook"), runs_under_quick()});
}

ClassSchema scene_class() {
  return named(
      "Scene", "A scene of a Wall, by the name of its file in scenes/.",
      {text("title", "what it shows"), text("file", "if not scenes/NAME.hook"), runs_under_quick()},
      {"Fix"});
}

ClassSchema table_class() {
  ClassSchema table =
      named("Table", "A metric over two of what the study varied, each cell the mean of its runs.",
            {text("title", "heading; default: the metric"),
             required(words("rows", 1, "what runs down: subject, or a sweep")),
             required(words("columns", 1, "what runs across: subject, or a sweep")),
             required(words("value", 1, "the metric in the cells")),
             words("subjects", 100, "subjects that enter; default: all"),
             may_be_empty("no run of it has a value")},
            {"Only"});
  table.only_in = "Study";
  return table;
}

ClassSchema measure_class() {
  return named(
      "Measure",
      "A metric to measure: by its name one that there is, or one of your own, `of` what ports "
      "say, or of the distance from a `trace`.",
      {words("over", 1, "of `anisotropy`: the Sweep of directions; default azimuth"),
       formula("of", "a port or an expression of ports, of every step"),
       words("trace", 1,
             "in the place of `of`: a Trace of the study's Cases; the distance of its port from "
             "what was measured, at every sample"),
       choice("take", simulation::reduction_names(), "last",
              "what becomes of its values; the manual defines each"),
       at_least_zero(number("from", "s", "values before do not count; default: settle")),
       positive(number("to", "s", "values after do not count; default: the run's end")),
       words("unit", 1, "of its values: mm, \"m/s\", deg; default: the SI unit"),
       number("level", "?",
              "of `time_at`, `count_above`, `time_above`; of `settle_time` what it settles about, "
              "if not where it ends"),
       positive(number("band", "?", "of `settle_time`: how far off counts as settled")),
       formula("predicted",
               "the closed form, of Params of the scene and of fields that hold a number there")});
}

ClassSchema truth_class() {
  ClassSchema truth = named(
      "Truth", "What a metric must be; its name is the metric's unless `metric` says otherwise.",
      {words("metric", 1, "the metric, where the name is a label"),
       choice("equals", {"predicted", "value"}, "", "the closed form, or the number in `value`"),
       number("value", "?", "the number that the metric must equal"),
       with_default(at_least_zero(number("tolerance", "",
                                         "allowed difference relative to the expected value")),
                    "0"),
       at_least_zero(number("within", "?", "allowed absolute difference")),
       number("above", "?", "the metric must be greater"),
       number("below", "?", "the metric must be less"),
       words("same_over", 1, "the value must be that at this sweep's first value"),
       words("subjects", 100, "subjects that it covers; default: all"),
       may_be_empty("it judges no run")},
      {"Only"});
  return truth;
}

ClassSchema claim_class() {
  ClassSchema claim = named(
      "Claim", "The sentence that answers the study's question, with numbers of its runs.",
      {required(text("text",
                     "the sentence; in braces [least, largest or predicted] METRIC [of SUBJECT] "
                     "[at SWEEP = VALUE], two with / between them, or subject of least METRIC")),
       words("truth", 100,
             "Truths that it stands and falls with; default: those of the metrics that it names"),
       may_be_empty("no run has one of its numbers")},
      {"Only"});
  claim.only_in = "Study";
  return claim;
}

/// What blocks that vary a scene's constants have in common, before their own fields.
void add_varied_scene(ClassSchema& block, std::string question) {
  const std::vector<FieldSchema> common{
      text("title", "heading of the report"), text("question", std::move(question)),
      required(text("scene", "file of the world, whose Params may be varied")),
      text("terrain",
           "file of a Terrain and its Material, in the place of the scene's; its Params may be "
           "varied"),
      words("material", 1,
            "the Material whose fields are varied; default: that of the ground, where it has one "
            "alone")};
  block.fields.insert(block.fields.begin(), common.begin(), common.end());
  block.top_level = true;
}

ClassSchema tune_class() {
  ClassSchema tune = named(
      "Tune",
      "Constants of a scene's ground, or any Params of it, searched for what its objectives ask.",
      {positive(number("duration", "s", "simulated time of every run; default: the scene's")),
       with_default(at_least_zero(number("settle", "s", "time from which metrics look")), "0"),
       positive(number("quick_duration", "s", "duration under --quick; default: a fifth")),
       at_least_zero(number("quick_settle", "s", "settle under --quick; default: a fifth")),
       choice("method", {"nsga2", "cmaes"}, "nsga2",
              "NSGA-II, for any number of objectives, or CMA-ES, for one"),
       with_default(within(8, 10000,
                           integer("population",
                                   "candidates of a generation; of nsga2 a "
                                   "multiple of 4")),
                    "40"),
       with_default(within(1, 10000,
                           integer("generations",
                                   "generations, the first guesses' own "
                                   "included")),
                    "25"),
       with_default(
           within(1, 1000, integer("seeds", "runs of a candidate, each with another seed")), "4"),
       with_default(at_least_zero(integer("seed", "of the search, not of the runs")), "1"),
       with_default(within(0, 100000,
                           integer("samples",
                                   "of Sobol's indices: each is samples (constants + 2) "
                                   "candidates; 0: none")),
                    "32")},
      {"Subject", "Vary", "Measure", "Objective", "Require", "Fix"});
  add_varied_scene(tune, "what is tuned for, first thing in the report");
  return tune;
}

/// What an Objective is asked for with: a word by itself.
ClassSchema direction_class(std::string name, std::string doc) {
  ClassSchema direction;
  direction.name = std::move(name);
  direction.only_in = "Objective";
  direction.doc = std::move(doc);
  direction.naming = Naming::forbidden;
  return direction;
}

ClassSchema calibrate_class() {
  ClassSchema calibrate = named(
      "Calibrate", "Constants of a scene's ground, or any Params of it, fitted to measured traces.",
      {words("subjects", 100,
             "laws, and engines with their settings, each calibrated by itself: hunt_crossley, "
             "mujoco_matched; default: the scene's own, unless there are Subjects"),
       with_default(within(0, 1000,
                           integer("folds",
                                   "parts of a cross-validation over the traces; "
                                   "below 2: none")),
                    "5"),
       with_default(within(0, 100000, integer("resamples", "samples of the bootstrap")), "200"),
       choice("bootstrap", {"refits", "one_step"}, "refits",
              "each sample is fitted anew, or solved with the model linearised at the optimum, "
              "without a run"),
       with_default(within(1, 10000,
                           integer("starts",
                                   "points all over the ranges that are looked "
                                   "at; the best are refined")),
                    "16"),
       choice("method", {"least_squares", "cmaes"}, "least_squares",
              "what is made least and how: the sum of all squares, by derivatives from the best "
              "`starts`, or the mean distance, which a run that went astray does not rule, by "
              "CMA-ES, which needs none"),
       with_default(within(8, 10000, integer("population", "of cmaes, places of a generation")),
                    "12"),
       with_default(within(1, 10000,
                           integer("generations",
                                   "of cmaes, the Latin hypercube it begins with "
                                   "included")),
                    "10"),
       within(1, 1000000,
              integer("most_cases",
                      "of cmaes, cases that a search looks at, drawn by `seed` from those that it "
                      "may; default: all")),
       with_default(at_least_zero(integer("seed", "of starts, bootstrap and folds")), "1")},
      {"Subject", "Vary", "Trace", "Cases", "Fix"});
  add_varied_scene(calibrate, "what is fitted and why, first thing in the report");
  return calibrate;
}

/// A Calibrate adds its traces up, each by its weight; Cases may be of a Study, which does not.
ClassSchema measured_trace_class(std::string within) {
  FieldSchema weight = number("weight", "?",
                              "1 over what one takes for its error: 1 / (0.5 mm); of an "
                              "orientation 1 / (1 deg); a Calibrate needs it");
  weight.required = within == "Calibrate";
  ClassSchema trace = named(
      "Trace", "A curve that was measured: columns of a table over time.",
      {required(text("file", "the table, comma-separated, with titles like `z [m]`")),
       required(words("column", 4,
                      "title of what was measured, \"z [m]\"; the three of a vector, or the four, "
                      "w, x, y, z, of an orientation")),
       text("time", "title of the column of times; default: the first column"),
       required(words("of", 1,
                      "trail of the port that was measured; of a vector or an orientation without "
                      "its parts")),
       number("offset", "s",
              "what the clock of the times reads at time 0 of the scene; default: 0, and a warning "
              "where the clock begins late. `Vary offset` of a Calibrate's Trace fits it"),
       std::move(weight)},
      within == "Calibrate" ? std::vector<std::string>{"Fix", "Vary"}
                            : std::vector<std::string>{"Fix"});
  trace.only_in = std::move(within);
  return trace;
}

ClassSchema cases_class() {
  return named(
      "Cases",
      "Runs that were measured, from tables: a row a case, whose columns set the Params that are "
      "called like them, and curves of many cases in the tables of its Traces. Of a Study it is "
      "an axis, as a Sweep is.",
      {required(text("file", "the table of the cases, comma-separated, with titles like `z [m]`")),
       required(words("case", 1,
                      "title of the column that says which case a row is of, here and in the "
                      "Traces' tables")),
       or_words(
           values("quick_values", "of a Study, the cases under --quick; default: first and last"))},
      {"Trace", "Only"});
}

void add_tune_classes(Schema& schema) {
  schema.add(tune_class());
  schema.add(calibrate_class());
  for (const char* within : {"Calibrate", "Cases"}) schema.add(measured_trace_class(within));
  schema.add(cases_class());
  schema.add(named(
      "Vary",
      "A constant to tune: a Param of the terrain's file or of the scene, a field of "
      "the Material, or one of the World.",
      {required(number("from", "?", "least value")), required(number("to", "?", "greatest value")),
       choice("scale", {"linear", "log"}, "linear", "how its range is searched")}));
  schema.add(
      named("Objective", "A metric to make small or great, or to bring to a target, by its name.",
            {choice("take", {"mean", "worst"}, "mean", "what is taken of the seeds' values"),
             number("target", "?",
                    "in the place of minimise and maximise: what the metric should be; minimised "
                    "is its distance from it, run by run")},
            {"minimise", "maximise"}));
  schema.add(direction_class("minimise", "the less the better"));
  schema.add(direction_class("maximise", "the more the better"));
  schema.add(
      named("Require", "What a metric must be with every seed, by its name.",
            {number("equals", "?", "the value"),
             at_least_zero(number("within", "?", "allowed difference from `equals`; default 0")),
             number("above", "?", "it must be greater"), number("below", "?", "it must be less")}));
}

}  // namespace

void add_study_classes(Schema& schema) {
  schema.add(study_class());
  schema.add(wall_class());
  schema.add(scene_class());
  schema.add(matrix_class());
  schema.add(part_class());
  schema.add(
      named("Subject", "One engine with its law, integrator and settings.",
            {of_world(schema, "engine", "which engine runs the scene"),
             of_world(schema, "contact", "the contact law, of engine dts"),
             of_world(schema, "integrator", "the integrator, of engine dts"),
             of_world(schema, "settings",
                      "a peer's settings: default, recommended, matched, and noslip of mujoco")},
            {"Fix", "Only"}));
  schema.add(named(
      "Sweep",
      "A Param of the scene to vary, or engine, contact, integrator, settings or terrain: "
      "`values`, or `from`, `to` and `step` (or `count`).",
      {or_words(values("values", "the values, in order: numbers, or words or strings")),
       number("from", "?", "first value"), number("to", "?", "last value"),
       number("step", "?", "distance between values"),
       at_least_zero(integer("count", "how many values from `from` to `to`")),
       choice("scale", {"linear", "log"}, "linear", "how `count` values are spaced"),
       or_words(values("quick_values", "the values under --quick; default: first and last"))}));
  schema.add(measure_class());
  schema.add(truth_class());
  ClassSchema plot = named(
      "Plot",
      "A figure: a metric over a sweep, two sweeps or another metric, or a signal over time.",
      {text("title", "heading; default: the name"),
       required(words("x", 1, "a sweep, a metric (a curve of cost against error), or time")),
       required(
           words("y", 1,
                 "a metric; over time a signal: displacement, drift, speed, penetration, energy; "
                 "with `colour` a sweep")),
       words("colour", 1, "a metric: makes a map over the sweeps x and y, a panel a subject"),
       words("outline", 1, "in a map: a metric whose closed form draws the line between cells"),
       words("series", 1, "what makes a curve: subject, or a sweep"),
       words("panels", 2,
             "a panel for each value of a sweep; of two, the first down, the second across"),
       choice("axes", {"same", "own"}, "same", "whether panels share the scale of y"),
       positive(number("floor", "?",
                       "what counts as zero where y is logarithmic; default: 1e-16 of y's unit")),
       words("subjects", 100, "subjects that are drawn; default: all"),
       choice("scale", {"linear", "log", "log_x", "log_log"}, "linear",
              "axes that are logarithmic: log is y; of a map log is the colour"),
       may_be_empty("no run of it has a value")},
      {"Only", "Reference"});
  plot.only_in = "Study";
  schema.add(std::move(plot));
  schema.add(table_class());
  schema.add(claim_class());
  schema.add(named("Reference",
                   "A line across a Plot at a value to hold the measured ones against.",
                   {text("title", "in the legend; default: the name"),
                    required(number("value", "?", "where it stands, in y"))},
                   {"Only"}));
  schema.add(named("Fix", "A value of a Param of the scene.",
                   {required(or_words(number("value", "?", "the value")))}));
  schema.add(named(
      "Only", "Restricts its owner to some values of a swept Param, or Cases to some of a column.",
      {or_words(values("values", "exactly these values")), number("from", "?", "least value"),
       number("to", "?", "greatest value")}));
  add_tune_classes(schema);
}

}  // namespace hookpoint::studies
