within ;
package Modelica
  "The classes of the Modelica Standard Library 4 that IwanJoint.mo names, as short as they can be"
  package Units
    package SI
      type Energy = Real(final unit="J");
      type Force = Real(final unit="N");
      type Mass = Real(final unit="kg");
      type Position = Real(final unit="m");
      type TranslationalSpringConstant = Real(final unit="N/m");
      type Velocity = Real(final unit="m/s");
    end SI;
  end Units;
  package Blocks
    package Interfaces
      type RealInput = Real;
      type RealOutput = Real;
    end Interfaces;
  end Blocks;
  package Icons
    partial model Example
    end Example;
  end Icons;
  package Mechanics
    package Translational
      package Interfaces
        connector Flange
          Modelica.Units.SI.Position s;
          flow Modelica.Units.SI.Force f;
        end Flange;
        partial model PartialCompliant
          Flange flange_a;
          Flange flange_b;
          Modelica.Units.SI.Position s_rel;
          Modelica.Units.SI.Force f;
        equation
          s_rel = flange_b.s - flange_a.s;
          flange_b.f = f;
          flange_a.f = -f;
        end PartialCompliant;
      end Interfaces;
      package Components
        model Mass
          parameter Modelica.Units.SI.Mass m = 1;
          Interfaces.Flange flange_a;
          Interfaces.Flange flange_b;
          Modelica.Units.SI.Position s;
          Modelica.Units.SI.Velocity v;
        equation
          flange_a.s = s;
          flange_b.s = s;
          v = der(s);
          m*der(v) = flange_a.f + flange_b.f;
        end Mass;
      end Components;
    end Translational;
  end Mechanics;
end Modelica;
