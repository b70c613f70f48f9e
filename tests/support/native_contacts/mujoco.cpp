#include <mujoco/mujoco.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/native_contacts/native_contact.h"

namespace hookpoint::native {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

mjModel* compiled(const std::string& text) {
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
  std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
  char error[1000] = "";
  mjModel* model = mj_loadXML("scene.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(error);
  return model;
}

class MujocoContact final : public Contact {
 public:
  MujocoContact(const Ball& ball, const std::string& snippet) : radius_(ball.radius) {
    const std::string inertia = number(great_inertia);
    const std::string text =
        "<mujoco>" + snippet +
        "<worldbody><geom type=\"plane\" size=\"100 100 1\"/><body><freejoint/>" +
        "<inertial pos=\"0 0 0\" mass=\"" + number(ball.mass) + "\" diaginertia=\"" + inertia +
        " " + inertia + " " + inertia + "\"/><geom type=\"sphere\" size=\"" + number(ball.radius) +
        "\"/></body></worldbody></mujoco>";
    model_ = compiled(text);
    data_ = mj_makeData(model_);
  }
  ~MujocoContact() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoContact(const MujocoContact&) = delete;
  MujocoContact& operator=(const MujocoContact&) = delete;

  void start(double depth, double approach, std::array<double, 3> gravity) override {
    mj_resetData(model_, data_);
    for (int i = 0; i < 3; ++i) model_->opt.gravity[i] = gravity[static_cast<std::size_t>(i)];
    data_->qpos[2] = radius_ - depth;
    data_->qvel[2] = -approach;
  }
  void step() override { mj_step(model_, data_); }
  std::array<double, 3> position() const override {
    return {data_->qpos[0], data_->qpos[1], data_->qpos[2]};
  }
  std::array<double, 3> velocity() const override {
    return {data_->qvel[0], data_->qvel[1], data_->qvel[2]};
  }

 private:
  double radius_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

}  // namespace

std::unique_ptr<Contact> mujoco_contact(const Ball& ball, const std::string& snippet) {
  return std::make_unique<MujocoContact>(ball, snippet);
}

MujocoRun mujoco_run(const std::string& xml, int steps) {
  mjModel* model = compiled(xml);
  mjData* data = mj_makeData(model);
  if (model->nkey > 0) mj_resetDataKeyframe(model, data, 0);
  for (int i = 0; i < steps; ++i) mj_step(model, data);
  mj_forward(model, data);
  MujocoRun run{{data->qpos, data->qpos + model->nq}, 0., {}};
  for (int geom = 0; geom < model->ngeom; ++geom)
    if (model->geom_type[geom] == mjGEOM_SPHERE)
      run.deepest =
          std::max(run.deepest, model->geom_size[3 * geom] - data->geom_xpos[3 * geom + 2]);
  for (int body = 0; body < model->nbody; ++body)
    run.inverse_weights.push_back(model->body_invweight0[2 * body]);
  mj_deleteData(data);
  mj_deleteModel(model);
  return run;
}

}  // namespace hookpoint::native
