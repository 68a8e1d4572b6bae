package gazed.spy;

import java.awt.BasicStroke;
import java.awt.Graphics2D;
import java.awt.Shape;
import java.awt.geom.Ellipse2D;
import java.awt.geom.RoundRectangle2D;

/** A NAO's torso and head, roughly to scale: some 0.10 m wide shoulders and a head of 0.12 m (Aldebaran documentation, "Dimensions"). */
final class RobotFigure {
  private RobotFigure() {}

  static void draw(Graphics2D g, Plane plane, PlanScale scale) {
    boolean above = plane == Plane.ABOVE;
    Shape torso = above ? new RoundRectangle2D.Double(-0.1, -0.04, 0.2, 0.08, 0.06, 0.06)
                        : new RoundRectangle2D.Double(-0.04, -0.085, 0.08, 0.19, 0.06, 0.06);
    Shape head = above ? new Ellipse2D.Double(-0.065, -0.05, 0.13, 0.11) : new Ellipse2D.Double(-0.055, 0.115, 0.11, 0.12);
    for (Shape part : new Shape[] {torso, head}) {
      Shape shape = scale.toScreen().createTransformedShape(part);
      g.setColor(Palette.faded(Palette.ROBOT, 60));
      g.fill(shape);
      g.setColor(Palette.ROBOT);
      g.setStroke(new BasicStroke(1.5f));
      g.draw(shape);
    }
  }
}
