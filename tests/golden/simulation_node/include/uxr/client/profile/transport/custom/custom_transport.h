#error "The component 'transport_custom' is not selected: add `transport: {type: custom}` to microros.yaml and generate again"
