use ahv::flight::Flight;
use ahv::linear::Linear;
#[test]
fn scratch() {
    let mut f = Flight::new().unwrap();
    f.initialise().unwrap();
    let t = f.trim().unwrap();
    println!("{:?}", t);
    let l = Linear::new(f.vehicle().unwrap(), &t.state, &t.control);
    println!("{:?}\n{:?}", l.poles(), l.zeros());
    f.set_input(0, 0.01);
    for i in 1..=100 {
        f.advance(i as f64 * 0.01).unwrap();
    }
    f.evaluate().unwrap();
    println!("{:?}", f.sample());
    println!("{:?} {}", f.state(), ahv::variables::guid());
    for i in 101..=500 {
        if let Err(e) = f.advance(i as f64 * 0.01) {
            println!("{e}");
            break;
        }
    }
}
