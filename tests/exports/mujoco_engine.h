#pragma once

#include <mujoco/mujoco.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_file.h"

namespace gapscope::testing {

/// MuJoCo itself with a model from its text.
class MujocoEngineRun {
 public:
  explicit MujocoEngineRun(const std::string& mjcf) {
    const TemporaryFile file(mjcf, "model.xml");
    char problem[1000] = "";
    model_ = mj_loadXML(file.path().c_str(), nullptr, problem, sizeof problem);
    if (model_ == nullptr) throw std::runtime_error(problem);
    data_ = mj_makeData(model_);
    mju_user_warning = [](const char*) {};  // which would go to a file in the working folder
  }
  ~MujocoEngineRun() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  MujocoEngineRun(const MujocoEngineRun&) = delete;
  MujocoEngineRun& operator=(const MujocoEngineRun&) = delete;

  const mjModel& model() const { return *model_; }

  /// What its encoder reads at every step, from its key on, the input held over each; shorter where the
  /// engine finds that it diverges.
  std::vector<double> motion(double step, mjtIntegrator integrator, const std::vector<double>& u) {
    return motion(step, integrator, u, [](double input, mjData&) { return input; });
  }

  /// The same where a loop sees the data before each step and makes ctrl of the input.
  template <class Loop>
  std::vector<double> motion(double step, mjtIntegrator integrator, const std::vector<double>& u,
                             const Loop& loop) {
    model_->opt.timestep = step;
    model_->opt.integrator = integrator;
    if (model_->nkey > 0)
      mj_resetDataKeyframe(model_, data_, 0);
    else
      mj_resetData(model_, data_);
    std::vector<double> x1 = {data_->qpos[0]};
    for (const double input : u) {
      data_->ctrl[driven()] = loop(input, *data_);
      mj_step(model_, data_);
      mj_checkPos(model_, data_);
      mj_checkVel(model_, data_);
      for (const int warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
        if (data_->warning[warning].number > 0) return x1;
      x1.push_back(data_->qpos[0]);
    }
    return x1;
  }

 private:
  /// The first actuator that passes its ctrl on.
  int driven() const {
    int i = 0;
    while (i + 1 < model_->nu && model_->actuator_gainprm[mjNGAIN * i] == 0.0) ++i;
    return i;
  }

  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

}  // namespace gapscope::testing
