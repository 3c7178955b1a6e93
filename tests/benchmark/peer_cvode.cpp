#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "benchmark/peer_drive.h"
#include "benchmark/peers.h"

namespace gapscope::benchmark_peers {
namespace {

constexpr double kFirstStep = 2e-3;  ///< after a restart, as a share of the sample

int derivative(double, N_Vector z, N_Vector dz, void* drive) {
  static_cast<PeerDrive*>(drive)->derivative(N_VGetArrayPointer(z), N_VGetArrayPointer(dz));
  return 0;
}

int guards(double, N_Vector z, double* g, void* drive) {
  static_cast<PeerDrive*>(drive)->guards(N_VGetArrayPointer(z), g);
  return 0;
}

int jacobian(double, N_Vector, N_Vector, SUNMatrix j, void* drive, N_Vector, N_Vector, N_Vector) {
  static_cast<PeerDrive*>(drive)->jacobian(reinterpret_cast<double(*)[4]>(SUNDenseMatrix_Data(j)));
  return 0;
}

void check(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(std::string("CVODE: ") + what + " failed");
}

/// CVODE with its root finding. It is started anew at each sample, since the input jumps there, and at each
/// event; all memory is taken once. Given its first step it need not search for one, which saves Adams a
/// third.
class CvodePeer final : public Peer {
 public:
  CvodePeer(const DriveParameters<double>& drive, int method) : start_(drive), drive_(drive) {
    check(SUNContext_Create(nullptr, &context_), "context");
    z_ = N_VNew_Serial(4, context_);
    cvode_ = CVodeCreate(method, context_);
    N_VConst(0.0, z_);
    check(CVodeInit(cvode_, derivative, 0.0, z_), "init");
    check(CVodeSetUserData(cvode_, &drive_), "user data");
    if (method == CV_BDF) {
      matrix_ = SUNDenseMatrix(4, 4, context_);
      linear_ = SUNLinSol_Dense(z_, matrix_, context_);
      check(CVodeSetLinearSolver(cvode_, linear_, matrix_), "linear solver");
      check(CVodeSetJacFn(cvode_, jacobian), "Jacobian");
    } else {
      nonlinear_ = SUNNonlinSol_FixedPoint(z_, 0, context_);
      check(CVodeSetNonlinearSolver(cvode_, nonlinear_), "nonlinear solver");
    }
    int falling[kGuards] = {-1, -1, -1, -1};
    check(CVodeRootInit(cvode_, kGuards, guards), "roots");
    check(CVodeSetRootDirection(cvode_, falling), "root directions");
    check(CVodeSetNoInactiveRootWarn(cvode_), "warnings");
    check(CVodeSetMaxNumSteps(cvode_, 100000), "steps");
  }
  CvodePeer(const CvodePeer&) = delete;
  CvodePeer& operator=(const CvodePeer&) = delete;
  ~CvodePeer() override {
    CVodeFree(&cvode_);
    if (linear_ != nullptr) SUNLinSolFree(linear_);
    if (matrix_ != nullptr) SUNMatDestroy(matrix_);
    if (nonlinear_ != nullptr) SUNNonlinSolFree(nonlinear_);
    N_VDestroy(z_);
    SUNContext_Free(&context_);
  }

  long run(std::span<const double> u, double dt, double tolerance, std::span<double> x1) override {
    drive_ = start_;
    N_VConst(0.0, z_);
    check(CVodeSStolerances(cvode_, tolerance, tolerance), "tolerances");
    for (std::size_t i = 0; i < u.size(); ++i) {
      x1[i] = N_VGetArrayPointer(z_)[0];
      drive_.set_input(u[i]);
      advance(dt);
    }
    return drive_.events;
  }

 private:
  void advance(double dt) {
    double t = 0.0;
    while (dt - t > 1e-14 * dt) {
      check(CVodeReInit(cvode_, t, z_), "restart");
      check(CVodeSetStopTime(cvode_, dt), "stop time");
      check(CVodeSetInitStep(cvode_, std::min(kFirstStep * dt, dt - t)), "first step");
      const int flag = CVode(cvode_, dt, z_, &t, CV_NORMAL);
      check(flag, "step");
      if (flag != CV_ROOT_RETURN) return;
      int found[kGuards] = {};
      check(CVodeGetRootInfo(cvode_, found), "root info");
      const auto guard = std::find_if(found, found + kGuards, [](int f) { return f != 0; }) - found;
      if (guard < kGuards) drive_.cross(static_cast<int>(guard), N_VGetArrayPointer(z_));
    }
  }

  PeerDrive start_, drive_;
  SUNContext context_ = nullptr;
  N_Vector z_ = nullptr;
  void* cvode_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver nonlinear_ = nullptr;
};

}  // namespace

std::unique_ptr<Peer> make_cvode_bdf_peer(const DriveParameters<double>& drive) {
  return std::make_unique<CvodePeer>(drive, CV_BDF);
}
std::unique_ptr<Peer> make_cvode_adams_peer(const DriveParameters<double>& drive) {
  return std::make_unique<CvodePeer>(drive, CV_ADAMS);
}

}  // namespace gapscope::benchmark_peers
