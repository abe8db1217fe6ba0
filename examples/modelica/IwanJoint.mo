within ;
package IwanJoint "An exported joint between two flanges"
  partial block Interface "What every exported joint driven in displacement has"
    Modelica.Blocks.Interfaces.RealInput displacement(unit="m");
    Modelica.Blocks.Interfaces.RealOutput force(unit="N");
    Modelica.Blocks.Interfaces.RealOutput dissipation(unit="J");
    Modelica.Blocks.Interfaces.RealOutput stored_energy(unit="J");
  end Interface;

  model Joint "Exported joint between two flanges"
    extends Modelica.Mechanics.Translational.Interfaces.PartialCompliant;
    replaceable block Unit = Elastic constrainedby Interface
      "The imported unit" annotation (choicesAllMatching=true);
    Unit unit;
    output Modelica.Units.SI.Energy dissipation = unit.dissipation;
    output Modelica.Units.SI.Energy stored_energy = unit.stored_energy;
  equation
    unit.displacement = s_rel;
    f = unit.force;
  end Joint;

  block Elastic "A joint that does not slip: stands in until the unit is imported"
    extends Interface;
    parameter Modelica.Units.SI.TranslationalSpringConstant stiffness = 1.09e7;
  equation
    force = stiffness*displacement;
    dissipation = 0;
    stored_energy = force*displacement/2;
  end Elastic;

  model Resonator "Two bodies and the joint between them, after a blow"
    extends Modelica.Icons.Example;
    Modelica.Mechanics.Translational.Components.Mass left(m=14, v(start=0, fixed=true),
      s(start=0, fixed=true));
    Modelica.Mechanics.Translational.Components.Mass right(m=14, v(start=0.023, fixed=true),
      s(start=0, fixed=true));
    Joint joint "redeclare block Unit = IwanJoint_fmu, the imported block";
  equation
    connect(left.flange_b, joint.flange_a);
    connect(joint.flange_b, right.flange_a);
    annotation (experiment(StopTime=0.5, Interval=2.5e-5));
  end Resonator;

  annotation (Documentation(info="<html>
<p>Import the archive that <code>iwan export JOINT.json -o joint.fmu --drive displacement</code>
wrote, in a tool that imports co-simulation units as blocks (Dymola does, OpenModelica does not):
most then make a block <code>IwanJoint_fmu</code> with input
<code>displacement</code> and output <code>force</code>. Put its name where
<code>Unit</code> is redeclared below, and <code>Joint</code> goes between two translational
flanges like a spring.</p>
<p>The unit is stepped by the tool's co-simulation interface: its output is held between
communication points. Choose the communication interval by
<code>iwan check joint.fmu RECORD --step SECONDS</code>; fifty points per period of the fastest
cycle lose 0.2 % of the dissipation.</p>
</html>"));
end IwanJoint;
