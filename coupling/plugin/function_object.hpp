#pragma once

#include <functional>
#include <memory>

#include "coupling/plugin/plugin_settings.hpp"
#include "coupling/scene/coupled_session.hpp"
#include "fvMeshFunctionObject.H"
#include "macro/openfoam/foam_flow_field.hpp"
#include "macro/openfoam/law_in_use.hpp"

namespace Foam {
namespace functionObjects {

/// Function object `hemoscale`: host 2 of the coupled loop, inside a stock solver of OpenFOAM.
///
/// Every coupling.interval steps it hands the flow to the session and the session's law to the
/// viscosity model `hemoscale`. It joins these parts and contains no numerics. Errors of the case
/// end the run when the function object is made (FatalIOError), later ones in execute (FatalError):
/// OpenFOAM would carry on after a FatalError in a constructor.
class hemoscaleCoupling : public fvMeshFunctionObject {
 public:
  TypeName("hemoscale");

  hemoscaleCoupling(const word& name, const Time& runTime, const dictionary& dict);
  ~hemoscaleCoupling() override;

  /// The dictionary changed on disk while the solver runs: has no effect, and says so.
  bool read(const dictionary& dict) override;
  bool execute() override;
  bool write() override { return true; }
  bool end() override;

 private:
  void begin(const dictionary& dict);
  void check_viscosity_model();
  void check_units() const;
  void check_points_inside() const;
  void check_feedback() const;
  void check_speed();
  scalar highest_speed() const;  // [mesh units]
  bool window_is_complete() const;
  void advance_window();
  void deliver_law();
  hemoscale::macro::FoamFlowField flow() const;
  std::map<std::string, double> figures() const;

  hemoscale::coupling::PluginSettings given_;
  std::unique_ptr<hemoscale::coupling::CoupledSession> session_;
  std::shared_ptr<const hemoscale::macro::PointLocator> locator_;
  hemoscaleLawInUse* law_in_use_ =
      nullptr;  // null: one-way in a solver with a viscosity of its own
  word velocity_name_;
  label first_step_ = 0;       // time index at which the run began
  label steps_in_window_ = 0;  // [-] steps of the solver per window
  label windows_ = 0;
  label own_corrections_ = 0;  // viscosity evaluations that were asked for here, not by the solver
  scalar window_begin_ = 0;    // [case's time]
  scalar usual_speed_ = 0;     // [mesh units] at the start, or in the first window
  bool is_one_way_ = false;
  bool is_steady_ = false;
  bool is_settled_ = false;  // a steady loop that needs no more windows
  bool is_finished_ = false;
  double coupling_time_ = 0;  // [s] wall time spent in the session
};

}  // namespace functionObjects
}  // namespace Foam
